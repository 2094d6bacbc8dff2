// Guards design.md 4: a new user's typing errors are reported at once, in one clear sentence, before anything
// is loaded.
#include <signal.h>

#include <QElapsedTimer>
#include <QFile>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestUsage : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsMistypedIsToldAtOnce_data();
  void whatIsMistypedIsToldAtOnce();
  void plainPathsOpenTheWindow_data();
  void plainPathsOpenTheWindow();
  void anEmptyPathIsNoPath();
  void plainPathRunsTheWindow();
  void openTellsOfEveryPath();
  void presetsAreListed_data();
  void presetsAreListed();
  void checksLeaveNothing();
  void wrongSeriesListsOneALine();
  void largestSeriesIsNamed();
  void aPictureIsAScene();
  void aDamagedPictureIsNoScene();
  void infoSpeaksAsTheWindowDoes();
  void infoCountsWhatIsNotShown();
  void interruptedCommandsEndBySignal_data();
  void interruptedCommandsEndBySignal();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  void write(const char* name, const QByteArray& bytes) const {
    QFile file(at(name));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
  }
  QTemporaryDir folder_;
};

void TestUsage::whatIsMistypedIsToldAtOnce_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* line, int status, const char* sentence) {
    QTest::newRow(line) << QString::fromLatin1(line) << status << QString::fromLatin1(sentence);
  };
  row("rendre x", 2,
      "Unknown command \"rendre\". Did you mean render? Commands: open, render, slice, info, import, list, "
      "archive, "
      "forget, convert, export, segment, compare, measure, batch, accuracy, bench (plain `volumen` opens the "
      "window).");
  row("draw", 2, "Unknown command \"draw\". Commands: open");
  // PATH /nowhere does not exist, so these options must be checked before it.
  row("render /nowhere --preset CT-bone -o a.png", 2,
      "Unknown preset \"CT-bone\". Did you mean CT-Bone? (`volumen --list-presets` shows all)");
  row("render /nowhere --preset quite-another -o a.png", 2, "Unknown preset \"quite-another\". (`volumen");
  row("bench /nowhere --preset CT-bone", 2, "Did you mean CT-Bone?");
  row("accuracy /nowhere --preset CT-bone -o study", 2, "Did you mean CT-Bone?");
  row("render /nowhere --scene /no/scene.json -o a.png", 1,
      "Cannot read the scene /no/scene.json: no such file.");
  row("bench /nowhere --scene /no/scene.json", 1, "Cannot read the scene /no/scene.json: no such file.");
  row("accuracy /nowhere --scene /no/scene.json -o a", 1, "Cannot read the scene /no/scene.json");
  row("render /nowhere --size 12 -o a.png", 2, "--size: \"12\" is not WIDTHxHEIGHT in pixels");
  row("render /nowhere --size 40000x40000 -o a.png", 2, "--size must be 1x1 to 32768x32768.");
  row("render /nowhere --method preshaded --mode mip -o a.png", 2, "--method preshaded does not go with");
  row("render /nowhere -o /no/folder/a.png", 1, "Cannot write /no/folder/a.png: no such folder.");
  row("render /nowhere -o /proc/x.png", 1, "Cannot write /proc/x.png: no such folder.");
  row("render /nowhere -o a.png --stats /no/folder/a.json", 1, "Cannot write /no/folder/a.json");
  row("render /nowhere -o a.png --error-map /no/folder/a.nrrd", 1, "Cannot write /no/folder/a.nrrd");
  row("render /nowhere --turntable 3 -o /no/folder/a.png", 1, "Cannot write /no/folder/a-000.png");
  row("convert /nowhere -o /no/folder/a.nrrd", 1, "Cannot write /no/folder/a.nrrd: no such folder.");
  row("convert /nowhere -o /no/folder/a/", 1, "Cannot make the folder /no/folder/a/");
  row("convert /nowhere -o /proc/", 1, "/proc/ exists and is not an empty folder");
  row("segment /nowhere --range 1:2 -o /no/folder/a.seg.nrrd", 1, "Cannot write /no/folder/a.seg.nrrd");
  row("accuracy /nowhere -o /proc/x", 1, "Cannot make the folder /proc/x");
  row("bench --paper -o /proc/x", 1, "Cannot make the folder /proc/x");
  row("render /nowhere -o /tmp/none.png", 1, "Cannot open /nowhere: no such file or folder.");
  row("info nowhere", 1, "Cannot open nowhere: no such file or folder.");
  row("render phantom:sphere:8", 2, "Missing output file: use -o PICTURE (.png or .nrrd).");
  row("render", 2,
      "Missing PATH: a file, a folder, index:STUDY[/SERIES], archive:NAME/STUDY[/SERIES] or "
      "phantom:NAME[:SIZE].");
  row("improt x", 2, "Unknown command \"improt\". Did you mean import?");
  row("import", 2, "Missing PATH: files and folders.");
  row("import /nowhere --index /proc/x", 1, "Cannot make the folder /proc/x");
  row("list --studies --series", 2, "does not go with");
  row("forget --index /nowhere", 2, "Missing STUDY: its number in `volumen list`, or its UID.");
  row("forget 1 --undo", 2, "--undo takes no studies.");
  row("convert phantom:sphere:8", 2, "Missing -o FILE: the file to write, .nrrd");
  row("render phantom:sphere:8 --presets CT-Bone", 2, "Unknown option --presets. Did you mean --preset?");
  row("render phantom:sphere:8 other third -o a.png", 2, "Unexpected argument \"other\".");
  row("render phantom:sphere:8 -o", 2, "--output needs a value.");
  row("render phantom:sphere:8 --view top", 2, "--view: \"top\" is not one of anterior, posterior, left");
  row("render phantom:sphere:8 --threads many", 2,
      "--threads: \"many\" is not a whole number from 1 to 1024.");
  row("render phantom:sphere:8 --step 1 --quality high -o a.png", 2, "does not go with");
  row("render phantom:sphere:8 --size 1x1 --size 2x2", 2, "--size is given more than once.");
  row("--verison", 2, "Unknown option --verison. Did you mean --version?");
  row("segment phantom:sphere:8 --range bone -o a.seg.nrrd", 2, "--range: \"bone\" is not LOW:HIGH");
}

void TestUsage::whatIsMistypedIsToldAtOnce() {
  QFETCH(QString, line);
  QFETCH(int, status);
  QFETCH(QString, sentence);
  const Outcome a = runProgramIn(folder_.path(), QProcess::splitCommand(line));
  QVERIFY2(a.err.startsWith("volumen: " + sentence.toUtf8()) || a.err.contains(sentence.toUtf8()), a.err);
  QCOMPARE(a.status, status);
  QVERIFY(a.out.isEmpty());
}

void TestUsage::plainPathsOpenTheWindow_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"", "phantom:sphere:8", "here.nrrd", "open here.nrrd", "./here.nrrd phantom:ramp:8"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

// Without a display the message says so, and the status is that of `open`.
void TestUsage::plainPathsOpenTheWindow() {
  QFETCH(QString, line);
  write("here.nrrd", "");
  const Outcome a = runProgramIn(folder_.path(), QProcess::splitCommand(line));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.startsWith("volumen: No display can be reached") && a.err.count('\n') == 1, a.err);
}

// A script passes an empty path if its variable is not set.
void TestUsage::anEmptyPathIsNoPath() {
  const Outcome a = runProgram(QStringList{QStringLiteral("info"), QString()});
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.startsWith("volumen: PATH: \"\" is not a file or folder."), a.err);
  const Outcome b =
      runProgram({QStringLiteral("render"), QStringLiteral("phantom:sphere:8"), QStringLiteral("--series"),
                  QString(), QStringLiteral("-o"), QStringLiteral("a.png")});
  QCOMPARE(b.status, 2);
  QVERIFY2(b.err.startsWith("volumen: --series: \"\" is not a series"), b.err);
}

// With a display the window stays open until it is closed, here by SIGINT.
void TestUsage::plainPathRunsTheWindow() {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
  environment.insert(QStringLiteral("XDG_CONFIG_HOME"), folder_.path());
  process.setProcessEnvironment(environment);
  process.start(QStringLiteral(VOLUMEN_PROGRAM), {QStringLiteral("phantom:sphere:8")});
  QVERIFY(process.waitForStarted());
  QVERIFY(!process.waitForFinished(1500));
  ::kill(pid_t(process.processId()), SIGINT);
  QVERIFY(process.waitForFinished(30000));
  QCOMPARE(process.exitStatus(), QProcess::CrashExit);
  QCOMPARE(process.exitCode(), SIGINT);
}

void TestUsage::openTellsOfEveryPath() {
  const Outcome a = runProgram(QStringLiteral("open /no/a /no/b"));
  QCOMPARE(a.status, 1);
  QCOMPARE(a.err, QByteArray("volumen: Cannot open /no/a: no such file or folder.\n"
                             "volumen: Cannot open /no/b: no such file or folder.\n"));
}

void TestUsage::presetsAreListed_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"--list-presets", "render --list-presets", "render phantom:sphere:8 --list-presets"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestUsage::presetsAreListed() {
  QFETCH(QString, line);
  const Outcome a = runProgram(line);
  QCOMPARE(a.status, 0);
  const QList<QByteArray> names = a.out.split('\n');
  QVERIFY(names.contains("auto") && names.contains("CT-Bone") && names.contains("US-Fetal"));
}

void TestUsage::checksLeaveNothing() {
  const QTemporaryDir folder;
  for (const char* line : {"render /nowhere -o a.png --stats s.json", "convert /nowhere -o a.nrrd",
                           "convert /nowhere -o a/", "accuracy /nowhere -o deep/study"})
    QCOMPARE(runProgramIn(folder.path(), QProcess::splitCommand(QString::fromLatin1(line))).status, 1);
  QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
           QStringList());
}

void TestUsage::wrongSeriesListsOneALine() {
  QDir(folder_.path()).mkdir(QStringLiteral("two"));
  QCOMPARE(runProgram(QStringLiteral("convert phantom:ramp:8 -o ") + at("two/a.nrrd")).status, 0);
  QCOMPARE(runProgram(QStringLiteral("convert phantom:sphere:8 -o ") + at("two/b.nrrd")).status, 0);
  const QString two = at("two");
  const Outcome a = runProgram(QStringLiteral("render %1 --series 9 -o a.png").arg(two));
  QCOMPARE(a.status, 1);
  QCOMPARE(QString::fromUtf8(a.err), QStringLiteral("volumen: Unknown series \"9\". %1 holds:\n"
                                                    "  1  a.nrrd, 8 slices\n  2  b.nrrd, 8 slices\n")
                                         .arg(two));
}

void TestUsage::largestSeriesIsNamed() {
  QDir(folder_.path()).mkdir(QStringLiteral("sizes"));
  QCOMPARE(runProgram(QStringLiteral("convert phantom:ramp:8 -o ") + at("sizes/a.nrrd")).status, 0);
  QCOMPARE(runProgram(QStringLiteral("convert phantom:sphere:9 -o ") + at("sizes/b.nrrd")).status, 0);
  const QString sizes = at("sizes");
  const Outcome a = runProgram(QStringLiteral("render %1 --size 8x8 -o %2").arg(sizes, at("largest.png")));
  QCOMPARE(a.status, 0);
  QVERIFY2(a.err.contains(" holds 2 series; using number 2, \"b.nrrd\" (the largest). Choose another with "
                          "--series."),
           a.err);
}

void TestUsage::aPictureIsAScene() {
  const QString made = at("made.png"), again = at("again.png");
  const QString line = QStringLiteral("render phantom:ct-head:24 --size 24x24 %1 -o %2");
  QCOMPARE(runProgram(line.arg(QStringLiteral("--preset CT-Bone --view left"), made)).status, 0);
  const Outcome a = runProgram(line.arg(QStringLiteral("--scene ") + made, again));
  QVERIFY2(a.status == 0, a.err);
  const QString key = QStringLiteral("volumen-scene");
  QVERIFY(!QImage(made).text(key).isEmpty());
  QCOMPARE(QImage(again).text(key), QImage(made).text(key));
  QCOMPARE(QImage(again), QImage(made));
  const QString plain = at("plain.png");
  QVERIFY(QImage(4, 4, QImage::Format_RGB32).save(plain));
  const Outcome b = runProgram(line.arg(QStringLiteral("--scene ") + plain, again));
  QCOMPARE(b.status, 1);
  QCOMPARE(QString::fromUtf8(b.err), QStringLiteral("volumen: %1 holds no scene.\n").arg(plain));
}

// No decoding library may print anything.
void TestUsage::aDamagedPictureIsNoScene() {
  const QString damaged = at("damaged.png");
  QVERIFY(QImage(400, 400, QImage::Format_RGB32).save(damaged));
  QByteArray bytes = contentsOf(damaged);
  bytes.replace(20, 6, "damage");
  write("damaged.png", bytes);
  for (const char* line : {"render phantom:sphere:8 -o %1/a.png --scene %1/damaged.png",
                           "bench phantom:sphere:8 --scene %1/damaged.png"}) {
    const Outcome a = runProgram(QString::fromLatin1(line).arg(folder_.path()));
    QCOMPARE(a.status, 1);
    QCOMPARE(QString::fromUtf8(a.err), QStringLiteral("volumen: %1 holds no scene.\n").arg(damaged));
  }
}

void TestUsage::infoSpeaksAsTheWindowDoes() {
  QCOMPARE(runProgram(QStringLiteral("convert phantom:ct-head:16 -o ") + at("head/")).status, 0);
  const Outcome a = runProgram(QStringLiteral("info ") + at("head"));
  QCOMPARE(a.status, 0);
  QVERIFY2(a.out.startsWith("Patient Volumen, Sample (VOLUMEN-SAMPLE)\n"
                            "  Study (no date) Synthetic head CT with contrast\n"
                            "    1  CT ct-head:16 (synthetic) (1)\n"
                            "       16 x 16 x 18 voxels of 15 x 15 x 15 mm, int16, DICOM, 18 files\n"),
           a.out);
}

void TestUsage::infoCountsWhatIsNotShown() {
  QDir(folder_.path()).mkdir(QStringLiteral("mixed"));
  QCOMPARE(runProgram(QStringLiteral("convert phantom:ramp:8 -o ") + at("mixed/a.nrrd")).status, 0);
  write("mixed/b.nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: bzip2\n\n");
  for (int n = 0; n < 9; ++n) write(qPrintable(QStringLiteral("mixed/%1.txt").arg(n)), "text");
  const QString line = QStringLiteral("info ") + at("mixed");
  const Outcome few = runProgram(line), all = runProgram(line + QStringLiteral(" --verbose"));
  QVERIFY2(few.out.contains("\n1 file could not be read; 9 others are not images.\n  "), few.out);
  // The path appears once.
  QVERIFY2(few.out.contains("mixed/b.nrrd: does not say the byte order"), few.out);
  QVERIFY2(few.out.contains("... and 4 more (--verbose lists all)") && !few.out.contains("8.txt"), few.out);
  QVERIFY2(all.out.contains("8.txt: not an image") && !all.out.contains("more (--verbose"), all.out);
}

void TestUsage::interruptedCommandsEndBySignal_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<int>("signal");
  QTest::newRow("render") << "render phantom:ct-head:96 --reference --size 900x900 -o a.png" << SIGINT;
  QTest::newRow("turntable")
      << "render phantom:ct-head:96 --turntable 9999 --reference --size 900x900 -o a.png" << SIGTERM;
  QTest::newRow("accuracy") << "accuracy phantom:ct-head:64 -o study" << SIGINT;
  QTest::newRow("bench") << "bench phantom:ct-head:64 --views 3600 --rounds 10000" << SIGINT;
}

// A shell ends its loop only if the command itself was ended by SIGINT.
void TestUsage::interruptedCommandsEndBySignal() {
  QFETCH(QString, line);
  QFETCH(int, signal);
  const QTemporaryDir folder;
  QProcess process;
  process.setWorkingDirectory(folder.path());
  process.start(QStringLiteral(VOLUMEN_PROGRAM), QProcess::splitCommand(line));
  QVERIFY(process.waitForStarted());
  // /proc tells when the program handles the signal.
  const QString status = QStringLiteral("/proc/%1/status").arg(process.processId());
  const auto handles = [&] {
    const QByteArray text = contentsOf(status);
    const qsizetype from = text.indexOf("SigCgt:") + 7;
    return (text.mid(from, text.indexOf('\n', from) - from).trimmed().toULongLong(nullptr, 16) >>
            (signal - 1)) &
           1;
  };
  QTRY_VERIFY_WITH_TIMEOUT(handles(), 30000);
  QTest::qWait(300);
  ::kill(pid_t(process.processId()), signal);
  QVERIFY(process.waitForFinished(60000));
  QCOMPARE(process.exitStatus(), QProcess::CrashExit);
  QCOMPARE(process.exitCode(), signal);
  QCOMPARE(process.readAllStandardError(), QByteArray("volumen: Interrupted; nothing was written.\n"));
  QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
           QStringList());
}

VOLUMEN_TEST(TestUsage);
#include "tst_usage.moc"
