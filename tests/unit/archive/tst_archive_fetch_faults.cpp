// Guards `volumen archive fetch` against archives that break off, lie or never end (C-GET): what came whole
// is kept, nothing half-written stays, and a sentence names the archive.
#include <QTemporaryDir>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/fake_scp.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveFetchFaults : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { files_ = instancesOfOneSeries(3); }
  void whatCameWholeIsKept_data();
  void whatCameWholeIsKept();

 private:
  using PdusOf = std::function<QByteArray(ScpLine&, const DimseMessage&)>;
  // Returns what gives images as it should, then sends something else, and ends the connection.
  ScpAnswer endAfter(int images, PdusOf pdus) const;
  void addThoseThatBreakOff();
  void addThoseThatLie();
  void addImagesThatLie();
  void addThoseThatNeverEnd();
  void addRow(const char* name, ScpAnswer get, int status, const QList<QByteArray>& kept,
              const char* sentence);
  QByteArray instance(int n) const { return dataSetIn(files_[n]); }
  // Sends one instance as the archive should.
  void give(ScpLine& line, int n) const {
    line.send(line.storage("1.2.1.1." + QByteArray::number(n + 1), instance(n)));
    line.receive();
  }

  QList<QByteArray> files_;  // of 1.2.1.1: "1.2.1.1.1" and so on
};

void TestArchiveFetchFaults::addRow(const char* name, ScpAnswer get, int status,
                                    const QList<QByteArray>& kept, const char* sentence) {
  QTest::newRow(name) << std::move(get) << status << kept << QByteArray(sentence);
}

void TestArchiveFetchFaults::whatCameWholeIsKept_data() {
  QTest::addColumn<ScpAnswer>("get");
  QTest::addColumn<int>("status");
  QTest::addColumn<QList<QByteArray>>("kept");  // data sets
  QTest::addColumn<QByteArray>("sentence");     // behind the name of the archive; empty: none
  addThoseThatBreakOff();
  addThoseThatLie();
  addImagesThatLie();
  addThoseThatNeverEnd();
}

ScpAnswer TestArchiveFetchFaults::endAfter(int images, PdusOf pdus) const {
  return [=, this](ScpLine& line, const DimseMessage& request) {
    for (int n = 0; n < images; ++n) give(line, n);
    line.send(pdus(line, request));
    line.hangUp();
  };
}

void TestArchiveFetchFaults::addThoseThatBreakOff() {
  const QList<QByteArray> first{instance(0)}, all{instance(0), instance(1), instance(2)};
  const char* const ended = "ended the connection.";
  const QByteArray abort = pduOf(pduAbort, QByteArray(4, '\0'));
  const PdusOf nothing = [](ScpLine&, const DimseMessage&) { return QByteArray(); };
  const PdusOf aborted = [=](ScpLine&, const DimseMessage&) { return abort; };
  const PdusOf begunImage = [this](ScpLine& line, const DimseMessage&) {
    return line.storage("1.2.1.1.2", instance(1)).chopped(100);
  };
  const PdusOf abortedImage = [=](ScpLine& line, const DimseMessage&) {
    const QByteArray data(10, '\0');
    return line.storage("1.2.1.1.2", data).chopped(dataPdu(1, 2, data).size()) + abort;
  };
  const PdusOf begunAnswer = [](ScpLine&, const DimseMessage& request) {
    return responseTo(request).chopped(10);
  };
  addRow("the end at once", endAfter(0, nothing), 1, {}, ended);
  addRow("an abort at once", endAfter(0, aborted), 1, {}, ended);
  addRow("the end after a first image", endAfter(1, nothing), 3, first, ended);
  addRow("an abort after a first image", endAfter(1, aborted), 3, first, ended);
  addRow("the end in the middle of an image", endAfter(1, begunImage), 3, first, ended);
  addRow("an abort between the command of an image and its data", endAfter(1, abortedImage), 3, first, ended);
  addRow("the end in the middle of the last answer", endAfter(3, begunAnswer), 0, all, "");
}

void TestArchiveFetchFaults::addThoseThatLie() {
  const QList<QByteArray> first{instance(0)}, all{instance(0), instance(1), instance(2)};
  const auto only = [this](const DimseResponse& response, int images) -> ScpAnswer {
    return [=, this](ScpLine& line, const DimseMessage& request) {
      for (int n = 0; n < images; ++n) give(line, n);
      line.send(responseTo(request, response));
    };
  };
  addRow("all is well, but nothing came", only({}, 0), 1, {}, "did not send all that it lists.");
  addRow("all is well, but one of three came", only({}, 1), 3, first, "did not send all that it lists.");
  addRow("a status that nobody knows", only({.status = 0x0123}, 1), 3, first,
         "ended the retrieval with status 0123.");
  addRow("no status", only({.hasStatus = false}, 1), 3, first, "does not keep to DICOM (");
  addRow("the answer to another message", only({.idOffset = 7}, 3), 0, all, "");
  addRow(
      "command and data of an image in two contexts",
      [this](ScpLine& line, const DimseMessage& request) {
        QByteArray pdus = line.storage("1.2.1.1.1", instance(0));
        constexpr qsizetype contextAt = 10;  // behind the heads of the PDU and of its first value
        pdus[contextAt] = char(request.context);
        line.send(pdus);
        line.receive();
      },
      1, {}, "does not keep to DICOM (");
}

void TestArchiveFetchFaults::addImagesThatLie() {
  const QList<QByteArray> first{instance(0)};
  const char* const notAll = "did not send all that it lists.";
  const auto stored = [](const QByteArray& uid, const QByteArray& dataSet) -> ScpAnswer {
    return [=](ScpLine& line, const DimseMessage& request) {
      line.send(line.storage(uid, dataSet));
      if (line.receive()) line.send(responseTo(request));
    };
  };
  addRow("an image that is called as another", stored("1.2.1.1.2", instance(0)), 3, first, notAll);
  addRow("an image of another series",
         stored("1.2.1.1.1", QByteArray(instance(0)).replace("1.2.1.1", "1.2.1.9")), 1, {}, notAll);
  addRow("an image of another study",
         stored("1.2.1.1.1",
                QByteArray(instance(0)).replace(QByteArray("1.2.1\0", 6), QByteArray("1.2.9\0", 6))),
         1, {}, notAll);
  addRow("an image without an image", stored("1.2.1.1.1", QByteArray()), 1, {}, notAll);
  addRow("an image that is cut before its UIDs", stored("1.2.1.1.1", instance(0).left(20)), 1, {}, notAll);
  const QByteArray cut = instance(0).chopped(10), deep = instance(0) + nestedSequences(20000);
  // An archive may hold nothing better.
  addRow("an image that is cut in its pixels, as the archive says that it is", stored("1.2.1.1.1", cut), 3,
         {cut}, notAll);
  addRow("20,000 sequences within each other", stored("1.2.1.1.1", deep), 3, {deep}, notAll);
  addRow("no DICOM", stored("1.2.1.1.1", QByteArray(5000, 'x')), 1, {}, notAll);
}

void TestArchiveFetchFaults::addThoseThatNeverEnd() {
  const QList<QByteArray> first{instance(0)}, all{instance(0), instance(1), instance(2)};
  const QByteArray unlisted = QByteArray(instance(0)).replace("1.2.1.1.1", "1.2.1.1.9");
  addRow(
      "data of 4 GiB", [](ScpLine& line, const DimseMessage&) { line.send(endlessPdu()); }, 1, {},
      "does not keep to DICOM (DUL Illegal PDU Length");
  addRow(
      "a command of 25,000 sequences within each other",
      [](ScpLine& line, const DimseMessage&) { line.send(deepCommand()); }, 1, {},
      "sent an answer that is too large.");
  const auto endless = [](const QByteArray& uid, const QByteArray& dataSet) -> ScpAnswer {
    return [=](ScpLine& line, const DimseMessage&) {
      do line.send(line.storage(uid, dataSet));
      while (line.receive());
    };
  };
  const char* const tooMany = "sends more images than it lists.";
  addRow("one image without end", endless("1.2.1.1.1", instance(0)), 3, first, tooMany);
  addRow("an image that it does not list without end", endless("1.2.1.1.9", unlisted), 3, {unlisted},
         tooMany);
  addRow("an image of another series without end",
         endless("1.2.1.9.1", QByteArray(instance(0)).replace("1.2.1.1", "1.2.1.9")), 1, {}, tooMany);
  addRow(
      "pending answers without end",
      [](ScpLine& line, const DimseMessage& request) {
        const QByteArray many = responseTo(request, {.status = pendingStatus}).repeated(1000);
        while (line.isOpen()) line.send(many);
      },
      1, {}, "sends without end what was not asked for.");
  addRow(
      "one byte after another",
      [this](ScpLine& line, const DimseMessage& request) {
        for (int n = 0; n < 2; ++n) give(line, n);
        line.drip(line.storage("1.2.1.1.3", instance(2)), 2);
        line.receive();
        line.drip(responseTo(request), 20);
      },
      0, all, "");
}

void TestArchiveFetchFaults::whatCameWholeIsKept() {
  QFETCH(ScpAnswer, get);
  QFETCH(int, status);
  QFETCH(QList<QByteArray>, kept);
  QFETCH(QByteArray, sentence);
  const FakeScp peer([&](ScpLine& line, const DimseMessage& request) {
    request.field() == getRequest ? get(line, request) : answerRightly(line, request, files_);
  });
  const QTemporaryDir to;
  const Outcome done = runArchive(peer.port(), {QStringLiteral("fetch"), QStringLiteral("main"),
                                                QStringLiteral("1.2.1"), QStringLiteral("-o"), to.path()});
  QVERIFY2(done.status == status, done.err);
  QCOMPARE(done.err.count('\n'), sentence.isEmpty() ? 0 : 1);
  QVERIFY2(sentence.isEmpty() || done.err.startsWith("volumen: The archive \"main\" "), done.err);
  QVERIFY2(done.err.contains(sentence), done.err);
  QCOMPARE(dataSetsBelow(to.path()), kept);
}

VOLUMEN_TEST(TestArchiveFetchFaults);
#include "tst_archive_fetch_faults.moc"
