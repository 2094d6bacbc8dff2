// Guards what `volumen archive` leaves when it is killed or interrupted, when the disk is full, and when two
// programs fetch one study: nothing half-written, nothing lost, nothing fetched twice.
#include <signal.h>
#include <sys/resource.h>

#include <QTemporaryDir>
#include <atomic>

#include "io/archive/fetch_archive.h"
#include "io/files/name_for_uid.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/fake_scp.h"
#include "tests/unit/archive/running_archive.h"
#include "tests/unit/archive/web_peer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveEnds : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { files_ = instancesOfOneSeries(3); }
  void aKilledFetchGoesOnWhereItWas();
  void aWebFetchGoesOnWhereItWas_data();
  void aWebFetchGoesOnWhereItWas();
  void twoProgramsMayFetchOneStudy();
  void whatThisMachineLacksIsTold_data();
  void whatThisMachineLacksIsTold();
  void anInterruptedCommandLeavesNothingHalf_data();
  void anInterruptedCommandLeavesNothingHalf();

 private:
  QStringList fetching(int port, const QTemporaryDir& lists, const QString& to) const {
    return {QStringLiteral("fetch"),
            QStringLiteral("main"),
            QStringLiteral("1.2.1"),
            QStringLiteral("--archives"),
            writeListWith(port, lists.path()),
            QStringLiteral("-o"),
            to};
  }
  QByteArray storageOf(const ScpLine& line, int n) const {
    return line.storage("1.2.1.1." + QByteArray::number(n + 1), dataSetIn(files_[n]));
  }
  // Sends one image and the begin of the next one. Returns the rest of it.
  QByteArray sendOneAndAHalf(ScpLine& line) const {
    line.send(storageOf(line, 0));
    line.receive();
    const QByteArray next = storageOf(line, 1);
    line.send(next.chopped(100));
    return next.right(100);
  }
  QList<QByteArray> all() const { return {dataSetIn(files_[0]), dataSetIn(files_[1]), dataSetIn(files_[2])}; }

  QList<QByteArray> files_;  // of 1.2.1.1: "1.2.1.1.1" and so on
};

void TestArchiveEnds::aKilledFetchGoesOnWhereItWas() {
  std::atomic<bool> isInSecond = false;
  QByteArray askedLast;
  const FakeScp peer([&](ScpLine& line, const DimseMessage& request) {
    if (request.field() == getRequest) askedLast = request.text(0x0008, 0x0018);
    if (request.field() != getRequest || isInSecond) return answerRightly(line, request, files_);
    sendOneAndAHalf(line);
    isInSecond = true;
    line.fallSilent();
  });
  const QTemporaryDir lists, to;
  RunningArchive fetch(fetching(peer.port(), lists, to.path()));
  QTRY_VERIFY_WITH_TIMEOUT(isInSecond, 30000);
  QVERIFY(fetch.endsBy(SIGKILL));
  QVERIFY(dataSetsBelow(to.path()).contains(all()[0]));
  RunningArchive again(fetching(peer.port(), lists, to.path()));
  const Outcome done = again.outcome();
  QCOMPARE(done.status, 0);
  QCOMPARE(done.out, "Fetched 2 of 3 images; 1 was here already: " + to.path().toUtf8() + '\n');
  QCOMPARE(askedLast, QByteArray("1.2.1.1.2\\1.2.1.1.3"));
  QCOMPARE(dataSetsBelow(to.path()), all());
}

void TestArchiveEnds::aWebFetchGoesOnWhereItWas_data() {
  QTest::addColumn<int>("signal");
  QTest::newRow("killed") << SIGKILL;
  QTest::newRow("interrupted") << SIGINT;
}

void TestArchiveEnds::aWebFetchGoesOnWhereItWas() {
  QFETCH(int, signal);
  std::atomic<bool> isCut = false, isOver = false;
  QList<QByteArray> askedLast;
  const HttpPeer peer(
      [&](const HttpRequest& request) -> QByteArray {
        if (isListing(request)) return listing(request);
        if (isOver) {
          askedLast << request.path.mid(request.path.lastIndexOf('/') + 1);
          return partsOf({files_[request.path.right(1).toInt() - 1]});
        }
        isCut = true;
        return partsOf(files_).left(files_[0].size() + files_[1].size());
      },
      [&] {
        while (isCut && !isOver) QThread::msleep(5);
      });
  const QTemporaryDir lists, to;
  QStringList words = fetching(0, lists, to.path());
  words[4] = writeWebListWith(peer.url(), lists.path());
  RunningArchive fetch(words);
  QTRY_VERIFY_WITH_TIMEOUT(dataSetsBelow(to.path()).contains(all()[0]), 30000);
  const bool hasEnded = fetch.endsBy(signal);
  isOver = true;
  QVERIFY(hasEnded);
  if (signal == SIGINT) QCOMPARE(dataSetsBelow(to.path()), all().mid(0, 1));
  const Outcome done = RunningArchive(words).outcome();
  QVERIFY2(done.status == 0, done.err);
  QCOMPARE(done.out, "Fetched 2 of 3 images; 1 was here already: " + to.path().toUtf8() + '\n');
  QCOMPARE(askedLast, (QList<QByteArray>{"1.2.1.1.2", "1.2.1.1.3"}));
  QCOMPARE(dataSetsBelow(to.path()), all());
}

void TestArchiveEnds::twoProgramsMayFetchOneStudy() {
  std::atomic<bool> isInSecond = false, isOtherDone = false;
  const FakeScp slow([&](ScpLine& line, const DimseMessage& request) {
    if (request.field() != getRequest) return answerRightly(line, request, files_);
    const QByteArray rest = sendOneAndAHalf(line);
    isInSecond = true;
    while (!isOtherDone && line.isOpen()) QThread::msleep(5);
    line.send(rest);
    line.receive();
    line.send(storageOf(line, 2));
    line.receive();
    line.send(responseTo(request));
  });
  const FakeScp quick(
      [&](ScpLine& line, const DimseMessage& request) { answerRightly(line, request, files_); });
  const QTemporaryDir lists, otherLists, to;
  RunningArchive first(fetching(slow.port(), lists, to.path()));
  QTRY_VERIFY_WITH_TIMEOUT(isInSecond, 30000);
  RunningArchive second(fetching(quick.port(), otherLists, to.path()));
  const Outcome secondDone = second.outcome();
  isOtherDone = true;
  QVERIFY2(secondDone.status == 0, secondDone.err);
  const Outcome firstDone = first.outcome();
  QVERIFY2(firstDone.status == 0, firstDone.err);
  QVERIFY(firstDone.err.isEmpty() && secondDone.err.isEmpty());
  QCOMPARE(dataSetsBelow(to.path()), all());
}

void TestArchiveEnds::whatThisMachineLacksIsTold_data() {
  QTest::addColumn<bool>("isWeb");
  QTest::addColumn<int>("mostBytes");  // of a file
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, int mostBytes, int status, const char* sentence) {
    for (const bool isWeb : {false, true})
      QTest::addRow("%s, %s", name, isWeb ? "DICOMweb" : "DIMSE")
          << isWeb << mostBytes << status << QByteArray(sentence);
  };
  row("no room for the second of three", 4 << 20, 3, "Images cannot be written to FOLDER: is the disk full?");
  row("no room for the workers that read what came", 64 << 10, 1, "(ulimit -f)");
}

void TestArchiveEnds::whatThisMachineLacksIsTold() {
  QFETCH(bool, isWeb);
  QFETCH(int, mostBytes);
  QFETCH(int, status);
  QFETCH(QByteArray, sentence);
  QList<QByteArray> files = files_;
  // A private element, which follows the pixels.
  files[1] +=
      QByteArray("\xe1\x7f\x10\x10OB\0\0", 8) + littleEndian(quint32(8000000)) + QByteArray(8000000, 'x');
  const FakeScp peer(
      [&](ScpLine& line, const DimseMessage& request) { answerRightly(line, request, files); });
  const HttpPeer web(
      [&](const HttpRequest& request) { return isListing(request) ? listing(request) : partsOf(files); });
  const QTemporaryDir lists, to;
  QStringList words = fetching(peer.port(), lists, to.path());
  if (isWeb) words[4] = writeWebListWith(web.url(), lists.path());
  const Outcome done = runProgram(QStringList{QStringLiteral("archive")} + words, [mostBytes] {
    const rlimit limit{rlim_t(mostBytes), rlim_t(mostBytes)};
    setrlimit(RLIMIT_FSIZE, &limit);
  });
  QVERIFY2(done.status == status, done.err);
  const QByteArray ofSeries = to.path().toUtf8() + '/' + volumen::nameForUid("1.2.1.1").c_str();
  QVERIFY2(done.err.contains(sentence.replace("FOLDER", ofSeries)), done.err);
  const QList<QByteArray> kept = dataSetsBelow(to.path());
  QCOMPARE(kept.isEmpty(), status == 1);
  for (const QByteArray& one : kept) QVERIFY(one == all()[0] || one == all()[2]);
}

void TestArchiveEnds::anInterruptedCommandLeavesNothingHalf_data() {
  QTest::addColumn<QStringList>("command");
  QTest::addColumn<QByteArray>("sentence");
  QTest::addColumn<int>("kept");
  const QString main = QStringLiteral("main");
  QTest::newRow("query") << QStringList{QStringLiteral("query"), main}
                         << QByteArray("volumen: Interrupted.\n") << 0;
  QTest::newRow("fetch") << QStringList{QStringLiteral("fetch"), main, QStringLiteral("1.2.1")}
                         << QByteArray(
                                "volumen: Interrupted; images that came whole are kept, and the next fetch "
                                "goes on from there.\n")
                         << 1;
  for (const char* name : {"send, before the first answer", "send, after the first answer"})
    QTest::newRow(name) << QStringList{QStringLiteral("send"), main}
                        << QByteArray("volumen: Interrupted; what was sent stays in the archive.\n") << 0;
}

// Each archive falls silent after a first answer.
void TestArchiveEnds::anInterruptedCommandLeavesNothingHalf() {
  QFETCH(QStringList, command);
  QFETCH(QByteArray, sentence);
  QFETCH(int, kept);
  std::atomic<bool> isSilent = false;
  const bool isFetch = command[0] == u"fetch", isQuery = command[0] == u"query",
             isSend = command[0] == u"send";
  const bool isAfterOne = QByteArray(QTest::currentDataTag()).contains("after");
  bool answersOne = isAfterOne;
  const FakeScp peer([&](ScpLine& line, const DimseMessage& request) {
    if (isFetch && request.field() == findRequest) return answerRightly(line, request, files_);
    if (request.field() == getRequest) sendOneAndAHalf(line);
    if (isQuery) line.send(responseTo(request, {.status = pendingStatus, .data = foundStudy("1.2.1")}));
    if (std::exchange(answersOne, false)) return line.send(responseTo(request));
    isSilent = true;
    line.fallSilent();
  });
  const QTemporaryDir lists, scans, to;
  for (const QByteArray& bytes : files_) {
    QFile file(scans.filePath(QString::number(files_.indexOf(bytes)) + QStringLiteral(".dcm")));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
  }
  if (isFetch) command << QStringLiteral("-o") << to.path();
  if (isSend) command << scans.path();
  RunningArchive running(command +
                         QStringList{QStringLiteral("--archives"), writeListWith(peer.port(), lists.path())});
  QTRY_VERIFY_WITH_TIMEOUT(isSilent, 30000);
  QVERIFY(running.endsBy(SIGINT));
  const Outcome ended = running.outcome();
  QCOMPARE(ended.err, sentence);
  QCOMPARE(ended.out, QByteArray(isAfterOne ? "Sent 1 of 3 instances to main\n" : ""));
  QCOMPARE(dataSetsBelow(to.path()), all().mid(0, kept));
}

VOLUMEN_TEST(TestArchiveEnds);
#include "tst_archive_ends.moc"
