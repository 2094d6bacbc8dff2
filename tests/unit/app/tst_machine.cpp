// Guards import.md and design.md 4: failures of the machine (open, fork, write) are reported as such and not
// remembered as faults of files. No partial output passes for complete.
#include <fcntl.h>
#include <grp.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <thread>

#include "io/worker/sandbox.h"
#include "tests/fixtures/mount_disk.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"
#include "tests/unit/worker/processes.h"

using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

using Before = std::function<void()>;

/// Stops or kills every worker of a program as soon as it starts, until the program ends.
class Disturber {
 public:
  Disturber(const QProcess& program, int signal)
      : thread_([pid = pid_t(program.processId()), signal, this] {
          std::set<pid_t> disturbed;
          while (!done_)
            for (const pid_t zygote : childrenOf(pid))
              for (const pid_t worker : childrenOf(zygote))
                if (disturbed.insert(worker).second) ::kill(worker, signal);
        }) {}
  ~Disturber() {
    done_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

}  // namespace

Q_DECLARE_METATYPE(Before)

class TestMachine : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void importReadsAllTheSame_data();
  void importReadsAllTheSame();
  void disturbedWorkersAreNoGuilt_data();
  void disturbedWorkersAreNoGuilt();
  void aKilledWorkerCostsNoSlice();
  void refusedFilesAreReadAgain();
  void nothingReadableIsAFailure();
  void fullOutputIsTold_data();
  void fullOutputIsTold();
  void fullDiskIsTold_data();
  void fullDiskIsTold();
  void killedConvertIsSwept_data();
  void killedConvertIsSwept();
  void hangUpEndsLikeInterrupt();
  void fewProcessesEndWithASentence();
  void parentOfWorkersHasNoRights();

 private:
  QString at(const char* name) const { return folder_->filePath(QString::fromLatin1(name)); }
  QStringList words(const char* line) const {
    QStringList all;
    for (const QString& word : QString::fromLatin1(line).split(QLatin1Char(' ')))
      all << (word.startsWith(QLatin1String("IN/")) ? folder_->filePath(word.mid(3)) : word);
    return all;
  }
  Outcome import(const Before& before = {}) const {
    return runProgram(words("import IN/scans --index IN/index"), before);
  }
  std::unique_ptr<QTemporaryDir> folder_;
};

void TestMachine::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  QCOMPARE(runProgram(words("convert phantom:ct-head:40 -o IN/scans/")).status, 0);
}

void TestMachine::importReadsAllTheSame_data() {
  QTest::addColumn<Before>("before");
  QTest::addColumn<int>("status");
  const auto row = [](const char* name, Before before, int status = 0) {
    QTest::newRow(name) << before << status;
  };
  row("all is well", [] {});
  row("stdin closed", [] { ::close(0); });
  row("stderr closed", [] { ::close(2); });
  row("stdin and stderr closed", [] {
    ::close(0);
    ::close(2);
  });
  row(
      "all three closed",
      [] {
        for (int fd = 0; fd <= 2; ++fd) ::close(fd);
      },
      1);  // it could not report its result
  row("24 descriptors", [] {
    const rlimit few{24, 24};
    ::setrlimit(RLIMIT_NOFILE, &few);
  });
  row("16 descriptors", [] {
    const rlimit few{16, 16};
    ::setrlimit(RLIMIT_NOFILE, &few);
  });
}

void TestMachine::importReadsAllTheSame() {
  QFETCH(Before, before);
  QFETCH(int, status);
  const Outcome a = import(before);
  QVERIFY2(a.status == status, a.err + a.out);
  const Outcome again = import();
  QVERIFY2(again.out.startsWith("44 files: 0 new, 0 changed, 44 unchanged, 0 gone, 0 refused"), again.out);
}

void TestMachine::disturbedWorkersAreNoGuilt_data() {
  QTest::addColumn<int>("signal");
  QTest::newRow("stopped") << SIGSTOP;
  QTest::newRow("killed") << SIGKILL;
}

// Disturbs every worker and its replacements, so that nothing can be read. The next import reads everything.
void TestMachine::disturbedWorkersAreNoGuilt() {
  QFETCH(int, signal);
  QProcess program;
  program.start(QStringLiteral(VOLUMEN_PROGRAM), words("import IN/scans --index IN/index"));
  QVERIFY(program.waitForStarted());
  {
    const Disturber disturber(program, signal);
    QVERIFY(program.waitForFinished(120'000));
  }
  const QByteArray err = program.readAllStandardError(), out = program.readAllStandardOutput();
  QVERIFY2(!out.contains("harm") && !err.contains("harm"), out + err);
  if (!out.contains(" 0 refused")) QVERIFY2(program.exitCode() != 0, out + err);
  const Outcome again = import();
  QVERIFY2(again.status == 0 && again.out.contains(" 0 refused"), again.out);
  const Outcome third = import();
  QVERIFY2(third.out.contains(" 44 unchanged"), third.out);
}

// Kills one worker repeatedly while headers are read. Each time another one reads its files.
void TestMachine::aKilledWorkerCostsNoSlice() {
  pid_t killed = 0;
  // On a busy machine the program may end before its workers are found.
  for (int attempt = 0; !killed && attempt < 50; ++attempt) {
    QProcess program;
    program.start(QStringLiteral(VOLUMEN_PROGRAM), words("convert IN/scans --strict -o IN/a.nrrd"));
    QVERIFY(program.waitForStarted());
    while (!killed && program.state() == QProcess::Running &&
           activityOf(pid_t(program.processId())).state != 'Z')
      for (const pid_t zygote : childrenOf(pid_t(program.processId())))
        for (const pid_t worker : childrenOf(zygote))
          if (!killed) ::kill(killed = worker, SIGKILL);
    QVERIFY(program.waitForFinished(120'000));
    QVERIFY2(program.exitCode() == 0, program.readAllStandardError());
  }
  QVERIFY(killed > 0);
}

void TestMachine::refusedFilesAreReadAgain() {
  QFile slice(at("scans/slice-00007.dcm"));
  QVERIFY(slice.resize(200));
  QCOMPARE(import().status, 3);
  const Outcome again = runProgram(words("import IN/scans --again --json --index IN/index"));
  QCOMPARE(again.status, 3);
  QCOMPARE(QJsonDocument::fromJson(again.out).object()[QLatin1String("refused")].toArray().size(), 1);
}

void TestMachine::nothingReadableIsAFailure() {
  for (const QFileInfo& file : QDir(at("scans")).entryInfoList(QDir::Files))
    QVERIFY(QFile(file.filePath()).resize(200));
  const Outcome a = import();
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("Nothing was imported"), a.err);
}

void TestMachine::fullOutputIsTold_data() {
  QTest::addColumn<QString>("line");
  for (const char* line : {"info IN/scans --json", "info IN/scans", "--help", "list --index IN/index --json",
                           "import IN/scans --index IN/other --json", "convert IN/scans -o IN/a.nrrd"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestMachine::fullOutputIsTold() {
  QFETCH(QString, line);
  QCOMPARE(import().status, 0);
  const Outcome a = runProgram(words(qPrintable(line)), [] { ::dup2(::open("/dev/full", O_WRONLY), 1); });
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("No space left on device"), a.err);
}

void TestMachine::fullDiskIsTold_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"convert phantom:ct-head:64 -o IN/small/a.nrrd", "convert phantom:ct-head:64 -o IN/small/a.nii.gz",
        "convert phantom:ct-head:64 -o IN/small/a/",
        "slice phantom:ct-head:64 --size 3000x3000 -o IN/small/a.png",
        "slice phantom:ct-head:64 --size 3000x3000 -o IN/small/a.nrrd",
        "segment phantom:ct-head:96 --range 0:99 -o IN/small/a.seg.nrrd",
        "segment phantom:ct-head:96 --range 0:99 -o IN/small/a.nii.gz",
        "segment phantom:ct-head:96 --range 0:99 -o IN/small/a.mha",
        "segment phantom:ct-head:96 --range 0:99 -o IN/small/a.stl"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestMachine::fullDiskIsTold() {
  QFETCH(QString, line);
  const QByteArray small = at("small").toUtf8();
  QVERIFY(QDir().mkpath(at("small")));
  MOUNT_DISK(small.constData(), 0, "size=8k");
  const Outcome a = runProgram(words(qPrintable(line)));
  const bool clean = fs::is_empty(small.toStdString());
  QCOMPARE(umount(small.constData()), 0);
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("No space left on device") && !a.err.contains("Unknown"), a.err);
  QVERIFY(clean);
}

void TestMachine::killedConvertIsSwept_data() {
  QTest::addColumn<QString>("output");
  QTest::newRow("a folder") << QStringLiteral("out/copy/");
  QTest::newRow("a file") << QStringLiteral("out/copy.nii.gz");
}

void TestMachine::killedConvertIsSwept() {
  QFETCH(QString, output);
  QVERIFY(QDir().mkpath(at("out")));
  const auto count = [&] { return std::distance(fs::directory_iterator(at("out").toStdString()), {}); };
  QProcess program;
  program.start(QStringLiteral(VOLUMEN_PROGRAM),
                {QStringLiteral("convert"), QStringLiteral("phantom:ct-head:256"), QStringLiteral("-o"),
                 folder_->filePath(output)});
  QVERIFY(program.waitForStarted());
  // The first temporary file only tests whether the folder is writable.
  const auto content = [&] {
    std::error_code gone;
    for (fs::recursive_directory_iterator it(at("out").toStdString(), gone), end; !gone && it != end;
         it.increment(gone)) {
      std::error_code none;
      if (it->is_regular_file(none) && it->file_size(none) > 0 && !none) return true;
    }
    return false;
  };
  while (program.state() == QProcess::Running && !content()) program.waitForFinished(1);
  program.kill();
  program.waitForFinished();
  QCOMPARE(count(), 1);
  QCOMPARE(runProgram(words("convert phantom:sphere:8 -o IN/out/other.nrrd")).status, 0);
  QCOMPARE(count(), 1);
  QVERIFY(QFile::exists(at("out/other.nrrd")));
}

void TestMachine::hangUpEndsLikeInterrupt() {
  QProcess program;
  program.start(
      QStringLiteral(VOLUMEN_PROGRAM),
      {QStringLiteral("convert"), QStringLiteral("phantom:ct-head:256"), QStringLiteral("-o"), at("copy/")});
  QVERIFY(program.waitForStarted());
  const auto aside = [&] {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_->path().toStdString()))
      if (entry.path().filename().string().starts_with(".volumen-") && entry.is_directory(none)) return true;
    return false;
  };
  while (program.state() == QProcess::Running && !aside()) program.waitForFinished(1);
  ::kill(pid_t(program.processId()), SIGHUP);
  QVERIFY(program.waitForFinished(60'000));
  QCOMPARE(program.exitStatus(), QProcess::CrashExit);
  QCOMPARE(program.exitCode(), SIGHUP);
  QVERIFY(!aside() && !QFile::exists(at("copy")));
}

// Runs as another user, as root has no limit of processes.
void TestMachine::fewProcessesEndWithASentence() {
  if (::geteuid() != 0) QSKIP("only root can become a user without processes");
  ::chmod(folder_->path().toUtf8().constData(), 0755);
  for (const int most : {1, 2, 3, 4}) {
    const Outcome a = runProgram(words("info IN/scans --json"), [most] {
      constexpr uid_t nobodyElse = 54321;
      const rlimit few{rlim_t(most), rlim_t(most)};
      if (::setgroups(0, nullptr) + ::setgid(nobodyElse) + ::setuid(nobodyElse) == 0)
        ::setrlimit(RLIMIT_NPROC, &few);
    });
    QVERIFY2(a.status == 0 || a.status == 1, a.err);
    const QJsonObject found = QJsonDocument::fromJson(a.out).object();
    if (a.status == 0)
      QCOMPARE(found[QLatin1String("volumes")].toArray().size(), 1);
    else
      QVERIFY2(found[QLatin1String("refused")][0][QLatin1String("reason")].toString().contains(
                   QLatin1String("no process could be started")),
               a.out);
  }
}

void TestMachine::parentOfWorkersHasNoRights() {
  if (volumen::worker::sanitized) QSKIP("under sanitizers workers keep their rights (io/worker/sandbox.h)");
  for (int n = 0; n < 2000; ++n)
    QVERIFY(QFile::copy(at("scans/slice-00001.dcm"), at("scans/") + QString::number(n)));
  QProcess program;
  program.start(QStringLiteral(VOLUMEN_PROGRAM), words("info IN/scans"));
  QVERIFY(program.waitForStarted());
  pid_t zygote = 0;
  std::string status;
  while (program.state() == QProcess::Running && status.find("Seccomp:\t2") == std::string::npos) {
    for (const pid_t child : childrenOf(pid_t(program.processId()))) zygote = child;
    std::ifstream file("/proc/" + std::to_string(zygote) + "/status");
    status.assign(std::istreambuf_iterator<char>(file), {});
    program.waitForFinished(1);
  }
  QVERIFY2(status.find("CapEff:\t0000000000000000") != std::string::npos, status.c_str());
  QVERIFY(status.find("NoNewPrivs:\t1") != std::string::npos);
  QVERIFY(status.find("Seccomp:\t2") != std::string::npos);
  QVERIFY(program.waitForFinished(120'000));
  QVERIFY2(!fs::exists("/proc/" + std::to_string(zygote)), "it was reaped");
}

VOLUMEN_TEST(TestMachine);
#include "tst_machine.moc"
