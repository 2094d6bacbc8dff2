// Guards `volumen batch` against everything that ends a piece of work or the program: what is there is whole,
// and the next run does the rest.
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QRandomGenerator>
#include <QScopeGuard>

#include "tests/fixtures/mount_disk.h"
#include "tests/unit/app/batch_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

// A picture that takes longer than any test waits.
QJsonObject slowPicture(const QString& output) {
  return piece(QStringLiteral("render"), output,
               {{QStringLiteral("method"), QStringLiteral("reference")},
                {QStringLiteral("size"), QStringLiteral("8192x8192")}});
}

// Starts a list of three pieces and waits until the first is done. The second is slow.
void startWithSlowPiece(const BatchFolder& folder, QProcess& process) {
  folder.write(QStringLiteral("jobs"),
               listOf({smallPicture(QStringLiteral("a.png")), slowPicture(QStringLiteral("b.png")),
                       smallPicture(QStringLiteral("c.png"))}));
  folder.start(process);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.at(QStringLiteral("a.png.volumen-stamp"))), 60000);
}

// Returns whether the line of a process that was ended tells how long it ran, and some memory.
bool tookAtLeast(const QJsonObject& line, double seconds) {
  return !line.contains(QStringLiteral("exit")) && line[QStringLiteral("seconds")].toDouble() >= seconds &&
         line[QStringLiteral("peakMebibytes")].toInt() > 5;
}

}  // namespace

class TestBatchSafety : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPoisonedPieceCostsItsLine();
  void aKilledProcessCostsItsLine();
  void littleMemoryIsSaid();
  void piecesBeforeTakeNoMemory();
  void whatTakesTooLongIsEnded();
  void twoProgramsMayDoOneList();
  void killedProgramsLeaveNothingHalf();
  void whatKilledProgramsLeftIsRemoved_data();
  void whatKilledProgramsLeftIsRemoved();
  void interruptionsLeaveNothingHalf();
  void interruptionsEndWhatDoesNotEndItself();
  void foldersAreWholeOrNotThere();
  void seriesAreFolders();
  void otherFoldersStay();
  void aFullDiskIsSaid();
};

void TestBatchSafety::aPoisonedPieceCostsItsLine() {
  const BatchFolder folder;
  folder.write(QStringLiteral("poison.dcm"), QByteArray(200, 'x'));
  QJsonObject badValue = smallPicture(QStringLiteral("c.png"));
  badValue[QStringLiteral("size")] = QStringLiteral("many");
  folder.write(QStringLiteral("jobs"),
               listOf({smallPicture(QStringLiteral("a.png")),
                       smallPicture(QStringLiteral("b.png"), QStringLiteral("poison.dcm")), badValue,
                       smallPicture(QStringLiteral("d.png"))}));
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 1);
  QMap<int, QString> ends = all(4, QStringLiteral("done"));
  ends[2] = ends[3] = QStringLiteral("failed");
  QCOMPARE(endsIn(a.out), ends);
  QCOMPARE(lineIn(a.out, 2)[QStringLiteral("exit")].toInt(), 1);
  QCOMPARE(lineIn(a.out, 3)[QStringLiteral("exit")].toInt(), 2);
  QVERIFY(!lineIn(a.out, 2)[QStringLiteral("warnings")].toArray().isEmpty());
  QVERIFY(!QFile::exists(folder.at(QStringLiteral("b.png"))));
  QVERIFY(folder.contents(QStringLiteral("a.png")) == folder.contents(QStringLiteral("d.png")));
}

void TestBatchSafety::aKilledProcessCostsItsLine() {
  const BatchFolder folder;
  QProcess process;
  startWithSlowPiece(folder, process);
  QTest::qWait(300);
  const QList<pid_t> children = childrenOf(process.processId());
  QCOMPARE(children.size(), 1);
  kill(children[0], SIGKILL);
  QVERIFY(process.waitForFinished(60000));
  QCOMPARE(process.exitCode(), 1);
  const QByteArray out = process.readAllStandardOutput();
  QMap<int, QString> ends = all(3, QStringLiteral("done"));
  ends[2] = QStringLiteral("failed");
  QCOMPARE(endsIn(out), ends);
  const QJsonArray said = lineIn(out, 2)[QStringLiteral("warnings")].toArray();
  QVERIFY2(said.contains(QStringLiteral("Its process was ended by signal 9.")), out);
  QVERIFY2(tookAtLeast(lineIn(out, 2), 0.1), out);
}

void TestBatchSafety::littleMemoryIsSaid() {
  NEED_LIMITED_MEMORY();
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"),
               listOf({smallPicture(QStringLiteral("a.png")),
                       smallPicture(QStringLiteral("b.png"), QStringLiteral("phantom:ct-head:512"))}));
  const Outcome a = folder.batch({QStringLiteral("--max-memory"), QStringLiteral("100M")});
  QCOMPARE(a.status, 1);
  QMap<int, QString> ends{{1, QStringLiteral("done")}, {2, QStringLiteral("failed")}};
  QCOMPARE(endsIn(a.out), ends);
  QCOMPARE(lineIn(a.out, 2)[QStringLiteral("exit")].toInt(), 1);
  QVERIFY2(a.out.contains("(the limit of --max-memory); allow more with --max-memory."), a.out);
}

// The second and the third piece would fail if the process kept what the first one read.
void TestBatchSafety::piecesBeforeTakeNoMemory() {
  NEED_LIMITED_MEMORY();
  const BatchFolder folder;
  const QString volume = QStringLiteral("phantom:ct-head:160");
  folder.write(
      QStringLiteral("jobs"),
      listOf({smallPicture(QStringLiteral("a.png"), volume),
              piece(QStringLiteral("segment"), QStringLiteral("b.seg.nrrd"),
                    {{QStringLiteral("path"), volume}, {QStringLiteral("recipe"), QStringLiteral("bone")}}),
              smallPicture(QStringLiteral("c.png"), volume)}));
  const Outcome a = folder.batch({QStringLiteral("--max-memory"), QStringLiteral("80M")});
  QVERIFY2(a.status == 0, a.out);
  QCOMPARE(endsIn(a.out), all(3, QStringLiteral("done")));
  QCOMPARE(lineIn(a.out, 3)[QStringLiteral("warnings")], lineIn(a.out, 1)[QStringLiteral("warnings")]);
  QVERIFY(folder.contents(QStringLiteral("a.png")) == folder.contents(QStringLiteral("c.png")));
}

void TestBatchSafety::whatTakesTooLongIsEnded() {
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"),
               listOf({slowPicture(QStringLiteral("a.png")), smallPicture(QStringLiteral("b.png"))}));
  const Outcome a = folder.batch({QStringLiteral("--timeout"), QStringLiteral("5")});
  QCOMPARE(a.status, 1);
  const QMap<int, QString> ends{{1, QStringLiteral("failed")}, {2, QStringLiteral("done")}};
  QCOMPARE(endsIn(a.out), ends);
  QVERIFY2(a.out.contains("Its process took longer than --timeout allows."), a.out);
  QVERIFY2(tookAtLeast(lineIn(a.out, 1), 5), a.out);
}

void TestBatchSafety::twoProgramsMayDoOneList() {
  const BatchFolder folder;
  QList<QJsonObject> pieces;
  for (int k = 0; k < 12; ++k)
    pieces << smallPicture(QStringLiteral("%1.png").arg(k), QStringLiteral("phantom:ct-head:%1").arg(24 + k));
  pieces << piece(QStringLiteral("convert"), QStringLiteral("series/"));
  folder.write(QStringLiteral("jobs"), listOf(pieces));
  QProcess one, two;
  folder.start(one), folder.start(two);
  QVERIFY(one.waitForFinished(120000) && two.waitForFinished(120000));
  QVERIFY2(one.exitCode() == 0 && two.exitCode() == 0,
           one.readAllStandardError() + two.readAllStandardError());
  QCOMPARE(endsIn(folder.batch().out), all(13, QStringLiteral("skipped")));
  QCOMPARE(folder.files().size(), 27);
  QCOMPARE(QDir(folder.at(QStringLiteral("series"))).entryList(QDir::Files).size(), 35);
}

void TestBatchSafety::killedProgramsLeaveNothingHalf() {
  const BatchFolder folder;
  QList<QJsonObject> pieces;
  for (int k = 0; k < 8; ++k) pieces << smallPicture(QStringLiteral("%1.png").arg(k));
  pieces << piece(QStringLiteral("convert"), QStringLiteral("series/"), {});
  folder.write(QStringLiteral("jobs"), listOf(pieces));
  QRandomGenerator random(76);
  for (int n = 0; n < std::max(6, qEnvironmentVariableIntValue("VOLUMEN_RANDOM_CASES")); ++n) {
    QProcess process;
    folder.start(process);
    QTest::qWait(int(random.bounded(250)));
    process.kill();
    QVERIFY(process.state() == QProcess::NotRunning || process.waitForFinished());
    for (int k = 0; k < 8; ++k)
      if (const QByteArray picture = folder.contents(QStringLiteral("%1.png").arg(k)); !picture.isEmpty())
        QVERIFY(picture.endsWith("IEND\xae\x42\x60\x82"));
    if (random.bounded(3) == 0) QFile::remove(folder.at(QStringLiteral("%1.png").arg(random.bounded(8))));
  }
  const Outcome a = folder.batch();
  QVERIFY2(a.status == 0, a.out + a.err);
  for (int k = 1; k < 8; ++k)
    QVERIFY(folder.contents(QStringLiteral("0.png")) == folder.contents(QStringLiteral("%1.png").arg(k)));
  QCOMPARE(QDir(folder.at(QStringLiteral("series"))).entryList(QDir::Files).size(), 35);
  QCOMPARE(endsIn(folder.batch().out), all(9, QStringLiteral("skipped")));
  QCOMPARE(folder.files().size(), 2 * 9 + 1);
}

void TestBatchSafety::whatKilledProgramsLeftIsRemoved_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<bool>("isLocked");
  QTest::addColumn<bool>("stays");
  QTest::newRow("a folder of a killed program") << QStringLiteral(".volumen-abcdef") << false << false;
  QTest::newRow("one whose maker lives") << QStringLiteral(".volumen-abcdef") << true << true;
  QTest::newRow("one of another name") << QStringLiteral(".volumen-abcde") << false << true;
}

// Also where nothing is to be done.
void TestBatchSafety::whatKilledProgramsLeftIsRemoved() {
  QFETCH(QString, name);
  QFETCH(bool, isLocked);
  QFETCH(bool, stays);
  const BatchFolder folder;
  QVERIFY(QDir(folder.at({})).mkdir(QStringLiteral("out")));
  folder.write(QStringLiteral("jobs"), listOf({smallPicture(QStringLiteral("out/a.png"))}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  const QString left = folder.at(QStringLiteral("out/") + name);
  QVERIFY(QDir().mkpath(left + QStringLiteral("/1/series")));
  const int lock = open(qPrintable(left), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const auto close = qScopeGuard([&] { ::close(lock); });
  if (isLocked) QCOMPARE(flock(lock, LOCK_EX), 0);
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
  QCOMPARE(QFile::exists(left), stays);
}

void TestBatchSafety::interruptionsLeaveNothingHalf() {
  const BatchFolder folder;
  QProcess process;
  startWithSlowPiece(folder, process);
  QTest::qWait(200);
  process.terminate();
  QVERIFY(process.waitForFinished(20000));
  QCOMPARE(process.exitStatus(), QProcess::CrashExit);  // ended by the signal
  const QMap<int, QString> ends{{1, QStringLiteral("done")}, {2, QStringLiteral("interrupted")}};
  QCOMPARE(endsIn(process.readAllStandardOutput()), ends);
  QCOMPARE(folder.files(), (QStringList{QStringLiteral("a.png"), QStringLiteral("a.png.volumen-stamp"),
                                        QStringLiteral("jobs")}));
}

// A stopped process stands for one that is far from its next look at the interruption.
void TestBatchSafety::interruptionsEndWhatDoesNotEndItself() {
  const BatchFolder folder;
  QProcess process;
  startWithSlowPiece(folder, process);
  QTest::qWait(200);
  const QList<pid_t> children = childrenOf(process.processId());
  QCOMPARE(children.size(), 1);
  QCOMPARE(kill(children[0], SIGSTOP), 0);
  folder.write(QStringLiteral(".volumen-abcdef"), "half");
  QElapsedTimer timer;
  timer.start();
  process.terminate();
  QVERIFY(process.waitForFinished(20000));
  QVERIFY2(timer.elapsed() < 3000, qPrintable(QString::number(timer.elapsed())));
  const QByteArray out = process.readAllStandardOutput();
  QCOMPARE(lineIn(out, 2)[QStringLiteral("end")].toString(), QStringLiteral("interrupted"));
  QVERIFY2(tookAtLeast(lineIn(out, 2), 0.1), out);
  QVERIFY(kill(children[0], 0) != 0);
  QCOMPARE(folder.files(), (QStringList{QStringLiteral("a.png"), QStringLiteral("a.png.volumen-stamp"),
                                        QStringLiteral("jobs")}));
}

void TestBatchSafety::foldersAreWholeOrNotThere() {
  const BatchFolder folder;
  const QString input = QStringLiteral("in.nrrd");
  QCOMPARE(runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(input))).status, 0);
  folder.write(QStringLiteral("jobs"), listOf({piece(QStringLiteral("convert"), QStringLiteral("series/"),
                                                     {{QStringLiteral("path"), input}})}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  QCOMPARE(QDir(folder.at(QStringLiteral("series"))).entryList(QDir::Files).size(), 35);
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
  QFile::remove(folder.at(input));
  QCOMPARE(runProgram(QStringLiteral("convert phantom:ct-head:24 -o %1").arg(folder.at(input))).status, 0);
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  QCOMPARE(QDir(folder.at(QStringLiteral("series"))).entryList(QDir::Files).size(), 26);
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
}

// However their names end, and also where a stamp no longer holds.
void TestBatchSafety::seriesAreFolders() {
  const BatchFolder folder;
  const QString scans = QStringLiteral("scans/");
  QCOMPARE(runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(scans))).status, 0);
  QJsonObject one = piece(QStringLiteral("export"), QStringLiteral("made"),
                          {{QStringLiteral("path"), scans},
                           {QStringLiteral("as"), QStringLiteral("series")},
                           {QStringLiteral("plane"), QStringLiteral("coronal")}});
  qsizetype before = 0;
  for (const int spacing : {40, 20}) {
    one[QStringLiteral("spacing")] = spacing;
    folder.write(QStringLiteral("jobs"), listOf({one}));
    const Outcome a = folder.batch();
    QVERIFY2(a.status == 0, a.out + a.err);
    QCOMPARE(endsIn(a.out), all(1, QStringLiteral("done")));
    const qsizetype count = QDir(folder.at(QStringLiteral("made"))).entryList(QDir::Files).size();
    QVERIFY(count > before);
    before = count;
  }
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
  QCOMPARE(folder.files().size(), 4);
}

void TestBatchSafety::otherFoldersStay() {
  const BatchFolder folder;
  QVERIFY(QDir(folder.at({})).mkdir(QStringLiteral("series")));
  folder.write(QStringLiteral("series/thesis.txt"), "years of work");
  folder.write(QStringLiteral("jobs"),
               listOf({piece(QStringLiteral("convert"), QStringLiteral("series/"), {})}));
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 1);
  QVERIFY2(a.out.contains("is there already, and no list made it"), a.out);
  QCOMPARE(folder.contents(QStringLiteral("series/thesis.txt")), QByteArray("years of work"));
}

void TestBatchSafety::aFullDiskIsSaid() {
  const BatchFolder folder;
  QVERIFY(QDir(folder.at({})).mkdir(QStringLiteral("disk")));
  const QByteArray disk = folder.at(QStringLiteral("disk")).toUtf8();
  MOUNT_DISK(disk.constData(), 0, "size=24k");
  const auto unmount = qScopeGuard([&] { umount(disk.constData()); });
  const QString big = QStringLiteral("disk/big.nrrd");
  folder.write(QStringLiteral("jobs"),
               listOf({smallPicture(QStringLiteral("disk/a.png")), piece(QStringLiteral("convert"), big),
                       piece(QStringLiteral("convert"), QStringLiteral("disk/series/"), {}),
                       smallPicture(QStringLiteral("b.png"))}));
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 1);
  const QMap<int, QString> ends = endsIn(a.out);
  QVERIFY2(ends[1] == QLatin1String("done") && ends[2] == QLatin1String("failed") &&
               ends[3] == QLatin1String("failed") && ends[4] == QLatin1String("done"),
           a.out);
  QVERIFY2(a.out.contains("No space left"), a.out);
  QVERIFY(!QFile::exists(folder.at(big)) && !QFile::exists(folder.at(QStringLiteral("disk/series"))));
}

VOLUMEN_TEST(TestBatchSafety);
#include "tst_batch_safety.moc"
