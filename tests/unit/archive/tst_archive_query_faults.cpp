// Guards `volumen archive query` against archives that break off, lie, never end or say nothing (C-FIND).
#include <QJsonArray>
#include <QJsonDocument>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/fake_scp.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveQueryFaults : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void searchesEnd_data();
  void searchesEnd();

 private:
  void addThoseThatBreakOff();
  void addThoseThatLie();
  void addThoseThatNeverEnd();
};

namespace {

void addSearch(const char* name, ScpAnswer find, int status, int studies, const char* sentence) {
  QTest::newRow(name) << std::move(find) << status << studies << QByteArray(sentence);
}

QByteArray pendingStudy(const DimseMessage& request, const QByteArray& uid = "1.2.1") {
  return responseTo(request, {.status = pendingStatus, .data = foundStudy(uid)});
}

// Returns what sends bytes behind a first study, and then ends the connection.
ScpAnswer studyThen(std::function<QByteArray(const DimseMessage&)> bytes) {
  return [bytes = std::move(bytes)](ScpLine& line, const DimseMessage& request) {
    line.send(pendingStudy(request) + bytes(request));
    line.hangUp();
  };
}

}  // namespace

void TestArchiveQueryFaults::searchesEnd_data() {
  QTest::addColumn<ScpAnswer>("find");
  QTest::addColumn<int>("status");
  QTest::addColumn<int>("studies");
  QTest::addColumn<QByteArray>("sentence");  // behind the name of the archive; empty: none
  addThoseThatBreakOff();
  addThoseThatLie();
  addThoseThatNeverEnd();
}

void TestArchiveQueryFaults::addThoseThatBreakOff() {
  const char* const ended = "ended the connection.";
  addSearch(
      "nothing, then the end", [](ScpLine& line, const DimseMessage&) { line.hangUp(); }, 1, 0, ended);
  addSearch("the end after a first answer", studyThen([](const DimseMessage&) { return QByteArray(); }), 1, 0,
            ended);
  addSearch("the end in the middle of an answer",
            studyThen([](const DimseMessage& request) { return pendingStudy(request).chopped(10); }), 1, 0,
            ended);
  addSearch("the end between command and data", studyThen([](const DimseMessage& request) {
              return responseTo(request, {.status = pendingStatus, .data = "x"}).chopped(13);
            }),
            1, 0, ended);
  addSearch("an abort", studyThen([](const DimseMessage&) { return pduOf(pduAbort, QByteArray(4, '\0')); }),
            1, 0, ended);
  addSearch("a wish to release the association",
            studyThen([](const DimseMessage&) { return pduOf(pduReleaseRequest, QByteArray(4, '\0')); }), 1,
            0, ended);
}

void TestArchiveQueryFaults::addThoseThatLie() {
  const auto last = [](const DimseResponse& response) {
    return studyThen([=](const DimseMessage& request) { return responseTo(request, response); });
  };
  addSearch("all is well", last({}), 0, 1, "");
  addSearch("the answer to another message", last({.idOffset = 7}), 1, 0, "does not keep to DICOM (DIMSE");
  addSearch("no status", last({.hasStatus = false}), 1, 0, "does not keep to DICOM (DIMSE");
  addSearch("a status that nobody knows", last({.status = 0x0123}), 3, 1,
            "ended the search with status 0123.");
  addSearch("an answer of another service", studyThen([](DimseMessage request) {
              request.command.replace(commandElement(0x0100, findRequest),
                                      commandElement(0x0100, storeRequest));
              return responseTo(request);
            }),
            1, 0, "does not keep to DICOM (DIMSE");
  addSearch("an answer that is no data set", studyThen([](const DimseMessage& request) {
              return responseTo(request, {.status = pendingStatus, .data = QByteArray(1000, 'x')});
            }),
            1, 0, "does not keep to DICOM (DIMSE");
  addSearch("an answer without data", studyThen([](const DimseMessage& request) {
              return responseTo(request, {.status = pendingStatus}) + responseTo(request);
            }),
            1, 0, "does not keep to DICOM (DIMSE");
}

void TestArchiveQueryFaults::addThoseThatNeverEnd() {
  const auto nested = [](int levels) {
    return studyThen([=](const DimseMessage& request) {
      return responseTo(request,
                        {.status = pendingStatus, .data = foundStudy("1.2.2") + nestedSequences(levels)});
    });
  };
  addSearch("data of 4 GiB", studyThen([](const DimseMessage&) { return endlessPdu(); }), 1, 0,
            "does not keep to DICOM (DUL Illegal PDU Length");
  addSearch("a command of 25,000 sequences within each other",
            studyThen([](const DimseMessage&) { return deepCommand(); }), 1, 0,
            "sent an answer that is too large.");
  addSearch("data of 25,000 sequences within each other", nested(25000), 1, 0,
            "sent an answer that is too large.");
  addSearch("data of 6,000 sequences within each other", nested(6000), 1, 0, "does not keep to DICOM (DIMSE");
  addSearch(
      "other studies without end",
      [](ScpLine& line, const DimseMessage& request) {
        for (int n = 1; line.isOpen(); ++n) line.send(pendingStudy(request, "1.2." + QByteArray::number(n)));
      },
      0, 5000, "may have more studies: only the first that it sent are listed.");
  addSearch(
      "one study without end",
      [](ScpLine& line, const DimseMessage& request) {
        const QByteArray many = pendingStudy(request).repeated(500);
        while (line.isOpen()) line.send(many);
      },
      0, 1, "may have more studies: only the first that it sent are listed.");
  addSearch(
      "one byte after another",
      [](ScpLine& line, const DimseMessage& request) {
        line.drip(pendingStudy(request) + responseTo(request), 10);
      },
      0, 1, "");
  addSearch(
      "silence", [](ScpLine& line, const DimseMessage&) { line.fallSilent(); }, 1, 0,
      "does not answer within 30 s.");
}

void TestArchiveQueryFaults::searchesEnd() {
  QFETCH(ScpAnswer, find);
  QFETCH(int, status);
  QFETCH(int, studies);
  QFETCH(QByteArray, sentence);
  const FakeScp peer(find);
  const Outcome done =
      runArchive(peer.port(), {QStringLiteral("query"), QStringLiteral("main"), QStringLiteral("--json")});
  QVERIFY2(done.status == status, done.err);
  QCOMPARE(QJsonDocument::fromJson(done.out)[QStringLiteral("studies")].toArray().size(), studies);
  QCOMPARE(done.err.count('\n'), sentence.isEmpty() ? 0 : 1);
  QVERIFY2(sentence.isEmpty() || done.err.startsWith("volumen: The archive \"main\" "), done.err);
  QVERIFY2(done.err.contains(sentence), done.err);
}

VOLUMEN_TEST(TestArchiveQueryFaults);
#include "tst_archive_query_faults.moc"
