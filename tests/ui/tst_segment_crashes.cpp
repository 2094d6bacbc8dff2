// Guards segments if the program is killed in a stroke or a job, or if the disk is full while they are saved.
// Also guards them if their series is left or closed during a job.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <QRegularExpression>
#include <QTemporaryDir>

#include "io/files/write_volume.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/mount_disk.h"
#include "tests/ui/killed_window.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/controller/open_session.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* crashFolder = "VOLUMEN_CRASH_FOLDER";  // set in the program that is killed

// Returns a ball among random values, whose segments take time and memory.
VolumePtr noisyBall() {
  constexpr int n = 96;
  Chance chance(7);
  return volumeOf<std::int16_t>(glm::ivec3(n), glm::dmat3(1), [&](glm::dvec3 pVoxel) {
    return (glm::length(pVoxel - (n - 1) / 2.0) < 40 ? 1000.0 : 0.0) + chance.below(200);
  });
}

// A window that shows a file's series in planes, with the Segments panel in front.
struct CrashWindow : Journey {
  explicit CrashWindow(const QString& path) : Journey({path}) {
    settle();
    window.resize(1440, 900);
    child<QAction>("layoutPlanes")->trigger();
    child<QDockWidget>("segmentDock")->raise();
    QCoreApplication::processEvents();
  }

  const Workspace& workspace() { return window.session().workspace(); }
  int steps() { return window.session().undoStack().index(); }
  bool isIdle() { return window.jobs().rows().empty(); }
  bool idle() {
    return QTest::qWaitFor([this] { return isIdle(); }, longest);
  }
  void click(const char* button) { QTest::mouseClick(child<QWidget>(button), Qt::LeftButton); }
  bool make(double low, double high) {
    click("segmentFromCurve");
    child<QDoubleSpinBox>("segmentLow")->setValue(low);
    child<QDoubleSpinBox>("segmentHigh")->setValue(high);
    click("segment");
    return idle();
  }
  void chooseStep(const char* kind) {
    click("segmentChange");
    auto* kinds = child<QComboBox>("segmentStepKind");
    kinds->setCurrentIndex(kinds->findData(QLatin1String(kind)));
  }
  // Paints one endless stroke into a new segment, a few pixels every 10 ms.
  void paint() {
    click("segmentAdd");
    child<QAction>("paintTool")->trigger();
    auto* view = window.views()->viewAs<FlatView>(axialViewId);
    Chance chance(3);
    QPoint at = view->rect().center();
    QTest::mousePress(view, Qt::LeftButton, {}, at);
    for (int n = 0; n < 10000; ++n) {
      at += QPoint(chance.below(13) - 6, chance.below(13) - 6);
      QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, {}, at);
      QTest::qWait(10);
    }
  }
  // Runs one job after another. The file `busy` exists while a job runs.
  void compute(QFile& busy) {
    for (int n = 0; n < 10000; ++n) {
      chooseStep(n % 2 ? "invert" : "gaussian");
      const int before = steps();
      click("segmentApply");
      (void)busy.open(QIODevice::WriteOnly);
      busy.close();
      (void)QTest::qWaitFor([&] { return steps() != before || isIdle(); }, longest);
      busy.remove();
      (void)idle();
    }
  }
};

// Stops the program while the file exists and leaves it stopped. Returns true on success.
bool isStoppedWhile(const QProcess& program, const QString& file) {
  const auto pid = pid_t(program.processId());
  return QTest::qWaitFor(
      [&] {
        ::kill(pid, SIGSTOP);
        QTest::qSleep(5);
        if (QFile::exists(file)) return true;
        ::kill(pid, SIGCONT);
        return false;
      },
      longest);
}

// A disk mounted over `folder`, which fill() fills until free().
class FullDisk {
 public:
  explicit FullDisk(const QByteArray& folder) : folder_(folder) {}
  ~FullDisk() { umount2(folder_.constData(), MNT_DETACH); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

  void fill() {
    const int file = ::open(fillerPath().constData(), O_WRONLY | O_CREAT, 0600);
    const QByteArray bytes(4096, 'x');
    while (::write(file, bytes.constData(), std::size_t(bytes.size())) > 0) {
    }
    ::close(file);
  }
  void free() { ::unlink(fillerPath().constData()); }

 private:
  QByteArray fillerPath() const { return folder_ + "/filler"; }

  QByteArray folder_;
};

// While it lives, this process can write no file of more bytes.
class ShortFiles {
 public:
  explicit ShortFiles(qint64 bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit few = before_;
    few.rlim_cur = rlim_t(bytes);
    ::setrlimit(RLIMIT_FSIZE, &few);
  }
  ~ShortFiles() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }
  ShortFiles(const ShortFiles&) = delete;
  ShortFiles& operator=(const ShortFiles&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

// Returns the only kept session as it would be restored; empty if there is none.
std::optional<OpenedSession> keptNow() {
  const QStringList names = keptSessions();
  if (names.size() != 1) return {};
  const auto opened = openSession(QDir(Autosave::folder()).filePath(names[0]).toStdString());
  return opened ? std::optional<OpenedSession>(*opened) : std::nullopt;
}

bool keeps(const Workspace& workspace) {
  const auto kept = keptNow();
  return kept && kept->problems.isEmpty() && sessionTextOf(kept->workspace) == sessionTextOf(workspace);
}

// Returns whether autosave names both maps: a copy without disk space, and the first one with its present
// display. Undoes its changes.
bool namesACopy(CrashWindow& w) {
  w.click("segmentDuplicate");
  if (!w.idle()) return false;
  w.click("segmentsIn3d");
  const auto namesBoth = [] {
    const auto kept = keptNow();
    return kept && kept->workspace.segmentMaps.size() == 2 && !kept->workspace.segmentMaps[0].in3d;
  };
  const bool isNamed = QTest::qWaitFor(namesBoth, longest);
  w.child<QAction>("undo")->trigger();
  w.child<QAction>("undo")->trigger();
  return isNamed;
}

// Returns incomplete files in the autosave folder.
QStringList leftovers() {
  static const QRegularExpression known(
      QStringLiteral("^[^.]+\\.volumen(\\.lock|\\.[0-9a-f]{40}\\.(seg\\.nrrd|labels))?$|^filler$"));
  QStringList names = QDir(Autosave::folder()).entryList(QDir::Files | QDir::Hidden);
  names.removeIf([](const QString& name) { return known.match(name).hasMatch(); });
  return names;
}

}  // namespace

class TestSegmentCrashes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void aWindowThatPaints();
  void aWindowThatComputes();
  void whatIsKilledIsAsItWas_data();
  void whatIsKilledIsAsItWas();
  void aFullDiskTakesNothing_data();
  void aFullDiskTakesNothing();

 private:
  static bool isKilled() { return qEnvironmentVariableIsSet(crashFolder); }
  // Runs the window that is killed. All its states are noted.
  void runUntilKilled(const std::function<void(CrashWindow&, const QDir&)>& run);
  QString at(const char* name) const { return dir_->filePath(QLatin1String(name)); }
  std::unique_ptr<QTemporaryDir> dir_;
};

void TestSegmentCrashes::init() {
  if (isKilled()) return;
  QDir(Autosave::folder()).removeRecursively();
  dir_ = std::make_unique<QTemporaryDir>();
}

void TestSegmentCrashes::runUntilKilled(const std::function<void(CrashWindow&, const QDir&)>& run) {
  if (!isKilled()) return;
  const QDir folder(qEnvironmentVariable(crashFolder));
  const QDir notes(folder.filePath(QStringLiteral("notes")));
  CrashWindow w(folder.filePath(QStringLiteral("ct.nrrd")));
  int number = 0;
  connect(&w.window.session(), &Session::workspaceChanged, this,
          [&](const Workspace&, const Workspace& after) { noteState(notes, number++, after); });
  QVERIFY(w.make(990, 1250));
  run(w, folder);
}

// Not tests. whatIsKilledIsAsItWas() starts them.
void TestSegmentCrashes::aWindowThatPaints() {
  runUntilKilled([](CrashWindow& w, const QDir&) { w.paint(); });
}
void TestSegmentCrashes::aWindowThatComputes() {
  runUntilKilled([](CrashWindow& w, const QDir& folder) {
    QFile busy(folder.filePath(QStringLiteral("busy")));
    w.compute(busy);
  });
}

void TestSegmentCrashes::whatIsKilledIsAsItWas_data() {
  QTest::addColumn<QString>("window");
  QTest::newRow("in a stroke") << QStringLiteral("aWindowThatPaints");
  QTest::newRow("in a job") << QStringLiteral("aWindowThatComputes");
}

void TestSegmentCrashes::whatIsKilledIsAsItWas() {
  QFETCH(QString, window);
  QVERIFY(writeVolume(*noisyBall(), at("ct.nrrd").toStdString()));
  const QDir notes(at("notes"));
  QVERIFY(QDir().mkpath(notes.path()));
  const auto program =
      startedTest("TestSegmentCrashes", window, {{QLatin1String(crashFolder), dir_->path()}}, at("output"));
  const auto isKept = [] {
    const QStringList names = keptSessions();
    return names.size() == 1 &&
           contentsOf(QDir(Autosave::folder()).filePath(names[0])).contains("segmentMaps");
  };
  QVERIFY2(QTest::qWaitFor(isKept, longest), contentsOf(at("output")));
  QTRY_VERIFY_WITH_TIMEOUT(notedStates(notes).size() > 5, longest);
  const qsizetype kept = statesKeptOnTheWay(notes);
  QVERIFY2(kept > 5, contentsOf(at("output")));
  if (window == QStringLiteral("aWindowThatComputes")) QVERIFY(isStoppedWhile(*program, at("busy")));
  killProgram(*program);
  const QStringList noted = notedStates(notes);
  Journey w;
  auto* offer = w.child<QWidget>("offerBar");
  QTRY_VERIFY_WITH_TIMEOUT(offer->isVisible(), longest);
  w.after([&] { QTest::mouseClick(w.child<QWidget>("offerAccept"), Qt::LeftButton); });
  const Workspace& restored = w.window.session().workspace();
  QCOMPARE(restored.segmentMaps.size(), std::size_t(1));
  QVERIFY(restored.segmentMaps.front().labels && !restored.segmentMaps.front().missing);
  const qsizetype state = noted.lastIndexOf(sessionTextOf(restored));
  QVERIFY2(state >= 0, "a state that the window had");
  QVERIFY2(state >= kept - 1, "what was done before it was kept last");
}

void TestSegmentCrashes::aFullDiskTakesNothing_data() {
  QTest::addColumn<bool>("isMounted");
  QTest::addColumn<bool>("hasRoomForSession");
  QTest::newRow("a disk without room") << true << false;
  QTest::newRow("no file may be written") << false << false;
  QTest::newRow("room for the session, none for labels") << false << true;
}

void TestSegmentCrashes::aFullDiskTakesNothing() {
  QFETCH(bool, isMounted);
  QFETCH(bool, hasRoomForSession);
  std::optional<FullDisk> disk;
  if (isMounted) {
    const QByteArray folder = Autosave::folder().toUtf8();
    QDir().mkpath(Autosave::folder());
    MOUNT_DISK(folder.constData(), 0, "size=8m");
    disk.emplace(folder);
  }
  QVERIFY(writeVolume(*noisyBall(), at("ct.nrrd").toStdString()));
  CrashWindow w(at("ct.nrrd"));
  QVERIFY(w.make(990, 1250));
  QTRY_VERIFY_WITH_TIMEOUT(keeps(w.workspace()), longest);
  const Workspace before = w.workspace();
  const QString file = QDir(Autosave::folder()).filePath(keptSessions()[0]);
  auto* banner = w.child<Banner>("banner");
  banner->hide();
  {
    std::optional<ShortFiles> few;
    if (isMounted)
      disk->fill();
    else
      few.emplace(hasRoomForSession ? QFileInfo(file).size() + 4096 : 0);
    QVERIFY(w.make(100, 150));  // every fourth voxel beside the ball
    QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
    QVERIFY2(banner->sentence().contains(QStringLiteral("Cannot write ") + Autosave::folder()),
             qPrintable(banner->sentence()));
    QCOMPARE(leftovers(), QStringList());
    QVERIFY2(keeps(before), "all that was kept before");
    // Everything except labels is kept.
    if (hasRoomForSession) {
      w.child<QAction>("viewLeft")->trigger();
      Workspace expected = w.workspace();
      expected.segmentMaps = before.segmentMaps;
      QTRY_VERIFY_WITH_TIMEOUT(keeps(expected), longest);
      QVERIFY(namesACopy(w));
    }
  }
  if (isMounted) disk->free();
  QCOMPARE(w.workspace().segmentMaps.front().segments.size(), std::size_t(2));
  w.child<QAction>("viewRight")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(keeps(w.workspace()), longest);
}

VOLUMEN_TEST(TestSegmentCrashes);
#include "tst_segment_crashes.moc"
