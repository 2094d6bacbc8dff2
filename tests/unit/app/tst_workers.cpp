// Guards import.md, "Safety", through the command line: a file that needs too much costs only itself, is
// named, and uses no memory of the program.
#include <sys/wait.h>

#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/fixtures/program.h"
#include "tests/unit/io/dicom_bytes.h"
#include "tests/unit/suite.h"
#include "tests/unit/worker/processes.h"

using namespace volumen::tests;

namespace {

void write(const std::string& path, const Buffer& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

/// Writes two elements of 250 MiB before a picture. The file is sparse on disk.
void writeLongHeader(const std::string& path) {
  constexpr std::uint32_t length = 250u << 20;
  std::ofstream out(path, std::ios::binary);
  Builder b = Builder::file();
  for (const std::uint32_t tag : {0x00091010u, 0x00091011u}) {
    b.longElement(tag, "OB", length);
    out.write(reinterpret_cast<const char*>(b.bytes.data()), std::streamsize(b.bytes.size()));
    out.seekp(length, std::ios::cur);
    b.bytes.clear();
  }
  const Buffer whole = native(picture("1.2.840.10008.1.2.1"));
  const std::size_t head = Builder::file().bytes.size();
  out.write(reinterpret_cast<const char*>(whole.data() + head), std::streamsize(whole.size() - head));
}

/// Writes a picture of 16,500 x 16,500 pixels (272 million). The file is sparse on disk.
void writeLargeFrame(const std::string& path) {
  constexpr unsigned edge = 16500;
  constexpr std::uint32_t length = edge * edge * 2;
  Buffer bytes = native(picture("1.2.840.10008.1.2.1"), length, 0);
  for (const std::uint8_t element : {std::uint8_t(0x10), std::uint8_t(0x11)}) {
    const Buffer tag{0x28, 0, element, 0, 'U', 'S', 2, 0};
    const auto at = std::search(bytes.begin(), bytes.end(), tag.begin(), tag.end());
    at[8] = std::uint8_t(edge & 0xff), at[9] = std::uint8_t(edge >> 8);
  }
  write(path, bytes);
  std::filesystem::resize_file(path, bytes.size() + length);
}

/// Returns the first working worker of a program, or 0 if the program ended without one.
pid_t workerOf(const QProcess& program) {
  while (program.state() == QProcess::Running && activityOf(pid_t(program.processId())).state != 'Z')
    for (const pid_t zygote : childrenOf(pid_t(program.processId())))
      for (const pid_t worker : childrenOf(zygote)) return worker;
  return 0;
}

}  // namespace

class TestWorkers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void costsItselfAlone();
  void stoppedFromOutsideItCostsNothing_data();
  void stoppedFromOutsideItCostsNothing();
  void sameWithoutWorkers();
  void largeFramesAreReadWhereThatIsAskedFor();
};

void TestWorkers::costsItselfAlone() {
  QTemporaryDir folder;
  const std::string study = folder.filePath(QStringLiteral("study")).toStdString();
  QVERIFY(QDir().mkpath(QString::fromStdString(study)));
  write(study + "/good", native(picture("1.2.840.10008.1.2.1")));
  writeLongHeader(study + "/long");
  const MeasuredOutcome run = runMeasured({"info", study, "--json", "--values"});
  QCOMPARE(run.status, 0);
#ifndef __SANITIZE_ADDRESS__  // AddressSanitizer keeps freed memory
  QVERIFY2(run.peakMebibytes < 512, qPrintable(QString::number(run.peakMebibytes)));
#endif
  const QJsonObject found = QJsonDocument::fromJson(run.out).object();
  QCOMPARE(found[QLatin1String("volumes")].toArray().size(), 1);
  const QJsonArray refused = found[QLatin1String("refused")].toArray();
  QCOMPARE(refused.size(), 1);
  QVERIFY(refused[0].toObject()[QLatin1String("path")].toString().endsWith(QLatin1String("/long")));
  QVERIFY(refused[0].toObject()[QLatin1String("reason")].toString().contains(QLatin1String("more memory")));
  const MeasuredOutcome drawn = runMeasured(
      {"render", study, "--size", "16x16", "-o", folder.filePath(QStringLiteral("a.png")).toStdString()});
  QCOMPARE(WEXITSTATUS(drawn.status), 3);
}

void TestWorkers::stoppedFromOutsideItCostsNothing_data() {
  QTest::addColumn<bool>("killed");
  QTest::newRow("is stopped") << false;
  QTest::newRow("is killed while it is stopped") << true;
}

// Stops a worker while it reads one of many headers. Another worker reads them.
void TestWorkers::stoppedFromOutsideItCostsNothing() {
  QFETCH(bool, killed);
  constexpr int count = 4000;
  QTemporaryDir folder;
  const Buffer bytes = native(picture("1.2.840.10008.1.2.1"));
  for (int n = 0; n < count; ++n) write(folder.filePath(QString::number(n)).toStdString(), bytes);
  QProcess program;
  program.start(QStringLiteral(VOLUMEN_PROGRAM),
                {QStringLiteral("info"), folder.path(), QStringLiteral("--json")});
  QVERIFY(program.waitForStarted());
  const pid_t worker = workerOf(program);
  QVERIFY(worker > 0);
  kill(worker, SIGSTOP);
  if (killed) {
    QTest::qSleep(1000);
    kill(worker, SIGKILL);
  }
  QVERIFY(program.waitForFinished(120'000));
  QCOMPARE(program.exitCode(), 0);
  const QJsonObject found = QJsonDocument::fromJson(program.readAllStandardOutput()).object();
  QCOMPARE(found[QLatin1String("refused")].toArray().size(), 0);
  QVERIFY(!found[QLatin1String("volumes")].toArray().isEmpty());
}

void TestWorkers::sameWithoutWorkers() {
  QTemporaryDir folder;
  const std::string good = folder.filePath(QStringLiteral("good")).toStdString();
  write(good, native(picture("1.2.840.10008.1.2.1")));
  write(folder.filePath(QStringLiteral("bomb")).toStdString(), deflateBomb());
  const QStringList words{QStringLiteral("info"), folder.path(), QStringLiteral("--json"),
                          QStringLiteral("--values")};
  const Outcome inWorkers = runProgram(words),
                here = runProgram(words + QStringList{QStringLiteral("--in-process")});
  QCOMPARE(inWorkers.status, 0);
  QVERIFY(inWorkers.out.contains("good") && inWorkers.out.contains("64 MiB"));
  QCOMPARE(inWorkers.out, here.out);
}

void TestWorkers::largeFramesAreReadWhereThatIsAskedFor() {
  QTemporaryDir folder;
  writeLargeFrame(folder.filePath(QStringLiteral("large")).toStdString());
  const QString info = QStringLiteral("info %1 --json ").arg(folder.path());
  const auto found = [](const Outcome& run) { return QJsonDocument::fromJson(run.out).object(); };
  const auto volumes = [&](const char* more) {
    return found(runProgram(info + QLatin1String(more)))[QLatin1String("volumes")].toArray();
  };
  const QJsonArray refused = found(runProgram(info))[QLatin1String("refused")].toArray();
  const QString reason = refused[0][QLatin1String("reason")].toString();
  QVERIFY2(reason.contains(QLatin1String("272 million pixels")) &&
               reason.contains(QLatin1String("--largest-frame")),
           qPrintable(reason));
  for (const char* more : {"--largest-frame 300", "--largest-frame 300 --in-process"}) {
    QCOMPARE(volumes(more).size(), 1);
    QCOMPARE(volumes(more)[0][QLatin1String("dims")], QJsonValue(QJsonArray{16500, 16500, 1}));
  }
  QVERIFY(volumes("--largest-frame 272").isEmpty());
  const Outcome wrong = runProgram(info + QStringLiteral("--largest-frame 0"));
  QCOMPARE(wrong.status, 2);
  QVERIFY2(wrong.err.contains("--largest-frame: \"0\" is not a number from 1 to 4295"), wrong.err);
}

VOLUMEN_TEST(TestWorkers);
#include "tst_workers.moc"
