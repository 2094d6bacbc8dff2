// Guards design.md 4: the window starts on a private display with settings that only the owner can read. Also
// guards the usage texts of the scripts that start the window and the tests.
#include <signal.h>
#include <sys/stat.h>

#include <QFile>
#include <QProcess>
#include <QSettings>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestWindowStart : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void settingsAreTheOwnersAlone_data();
  void settingsAreTheOwnersAlone();
  void aDisplayWithoutOthersIsNotLeft();
  void scriptsTellTheirUsage_data();
  void scriptsTellTheirUsage();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QTemporaryDir folder_;
};

namespace {

void endBySignal(QProcess& process) {
  ::kill(pid_t(process.processId()), SIGINT);
  QVERIFY(process.waitForFinished(60000));
}

}  // namespace

void TestWindowStart::initTestCase() {
  QCOMPARE(runProgram(QStringLiteral("convert phantom:sphere:8 -o ") + at("a.nrrd")).status, 0);
}

void TestWindowStart::settingsAreTheOwnersAlone_data() {
  QTest::addColumn<bool>("old");
  QTest::newRow("new ones") << false;
  QTest::newRow("those of an older program") << true;
}

// Settings contain the recently opened paths.
void TestWindowStart::settingsAreTheOwnersAlone() {
  QFETCH(bool, old);
  const QTemporaryDir home;
  const QString file = home.filePath(QStringLiteral("volumen/volumen.conf"));
  if (old) {
    QSettings(file, QSettings::IniFormat).setValue(QStringLiteral("a"), 1);
    QVERIFY(QFile::setPermissions(
        file, QFile::ReadOwner | QFile::WriteOwner | QFile::ReadGroup | QFile::ReadOther));
  }
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
  for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
    environment.insert(QString::fromLatin1(name), home.path());
  process.setProcessEnvironment(environment);
  process.setChildProcessModifier([] { ::umask(022); });
  process.start(QStringLiteral(VOLUMEN_PROGRAM), {at("a.nrrd")});
  QVERIFY(process.waitForStarted());
  QTRY_VERIFY_WITH_TIMEOUT(contentsOf(file).contains("a.nrrd"), 60000);
  endBySignal(process);
  struct stat status {};
  QCOMPARE(::stat(file.toUtf8().constData(), &status), 0);
  QCOMPARE(int(status.st_mode & 0777), 0600);
}

// Xvfb -terminate ends with its last client. Other servers restart then and reject clients meanwhile.
void TestWindowStart::aDisplayWithoutOthersIsNotLeft() {
  QProcess server;
  server.start(QStringLiteral("Xvfb"),
               {QStringLiteral("-displayfd"), QStringLiteral("1"), QStringLiteral("-terminate"),
                QStringLiteral("-screen"), QStringLiteral("0"), QStringLiteral("800x600x24")});
  if (!server.waitForStarted()) QSKIP("Xvfb is not installed: apt-get install xvfb");
  QTRY_VERIFY_WITH_TIMEOUT(server.canReadLine(), 60000);
  const QString display = QLatin1Char(':') + QString::fromLatin1(server.readLine().trimmed());
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("DISPLAY"), display);
  environment.remove(QStringLiteral("QT_QPA_PLATFORM"));
  environment.remove(QStringLiteral("WAYLAND_DISPLAY"));
  for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
    environment.insert(QString::fromLatin1(name), folder_.path());
  process.setProcessEnvironment(environment);
  process.start(QStringLiteral(VOLUMEN_PROGRAM), {at("a.nrrd")});
  QVERIFY(process.waitForStarted());
  const QString settings = at("volumen/volumen.conf");
  QTRY_VERIFY_WITH_TIMEOUT(contentsOf(settings).contains("a.nrrd") || process.state() == QProcess::NotRunning,
                           60000);
  QVERIFY2(process.state() == QProcess::Running, process.readAllStandardError().constData());
  QCOMPARE(server.state(), QProcess::Running);
  endBySignal(process);
  QVERIFY2(process.exitCode() == SIGINT, process.readAllStandardError().constData());
  QVERIFY(server.waitForFinished(60000));  // with its only client
}

void TestWindowStart::scriptsTellTheirUsage_data() {
  QTest::addColumn<QString>("script");
  for (const char* script : {"app/run.sh", "tests/run.sh", "tests/fuzz/run.sh"})
    QTest::newRow(script) << QString::fromLatin1(script);
}

// Usage texts need no installation or build.
void TestWindowStart::scriptsTellTheirUsage() {
  QFETCH(QString, script);
  for (const char* word : {"--help", "-h", "--nonsense"}) {
    QProcess process;
    process.start(QStringLiteral("bash"),
                  {QStringLiteral(VOLUMEN_SOURCE_DIR "/") + script, QString::fromLatin1(word)});
    QVERIFY(process.waitForFinished(60000));
    const bool isHelp = QByteArray(word) != "--nonsense";
    QCOMPARE(process.exitCode(), isHelp ? 0 : 2);
    const QByteArray said = isHelp ? process.readAllStandardOutput() : process.readAllStandardError();
    QVERIFY2(said.contains("usage: bash " + script.toUtf8()), said);
    QVERIFY2(isHelp || said.contains("unknown option --nonsense"), said);
  }
}

VOLUMEN_TEST(TestWindowStart);
#include "tst_window_start.moc"
