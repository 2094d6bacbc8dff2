// Guards import.md and design.md 4: with limits of the system set too low, no partial result passes for
// complete, and messages name the limit.
#include <sys/resource.h>
#include <unistd.h>

#include <QFile>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestLimits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { QFile::remove(at("a.nrrd")); }
  void closedOutputIsTold_data();
  void closedOutputIsTold();
  void limitsAreTold_data();
  void limitsAreTold();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QStringList words(const QString& line) const {
    QStringList all;
    for (const QString& word : line.split(QLatin1Char(' ')))
      all << (word.startsWith(QLatin1String("IN/")) ? folder_.filePath(word.mid(3)) : word);
    return all;
  }
  QTemporaryDir folder_;
};

// Writes more slices than one request holds.
void TestLimits::initTestCase() {
  QCOMPARE(runProgram(words(QStringLiteral("convert phantom:ct-head:150 -o IN/scans/"))).status, 0);
}

void TestLimits::closedOutputIsTold_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"info IN/scans --json", "info IN/scans", "--version", "convert IN/scans -o IN/a.nrrd"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestLimits::closedOutputIsTold() {
  QFETCH(QString, line);
  const Outcome a = runProgram(words(line), [] { ::close(1); });
  QVERIFY2(a.status == 1 && a.err.contains("stdout is closed"), a.err);
}

void TestLimits::limitsAreTold_data() {
  QTest::addColumn<int>("resource");
  QTest::addColumn<int>("most");
  QTest::addColumn<QByteArray>("advice");
  for (const int most : {6, 7, 8, 9, 10, 12})
    QTest::addRow("%d descriptors", most) << int(RLIMIT_NOFILE) << most << QByteArray("ulimit -n");
  QTest::addRow("no growing files") << int(RLIMIT_FSIZE) << 1024 << QByteArray("ulimit -f");
}

// Output is complete, or nothing is written and the message names the limit.
void TestLimits::limitsAreTold() {
  QFETCH(int, resource);
  QFETCH(int, most);
  QFETCH(QByteArray, advice);
#ifdef __SANITIZE_ADDRESS__
  if (resource == RLIMIT_NOFILE && most < 9)
    QSKIP(
        "the sanitizer asks through a pipe of its own whether memory can be read, and takes no answer for an "
        "error");
#endif
  const Outcome a = runProgram(words(QStringLiteral("convert IN/scans -o IN/a.nrrd")), [=] {
    const rlimit few{rlim_t(most), rlim_t(most)};
    ::setrlimit(__rlimit_resource(resource), &few);
  });
  QVERIFY2(a.status == 0 || (a.status == 1 && a.err.contains(advice)), QByteArray::number(a.status) + a.err);
  QCOMPARE(QFile::exists(at("a.nrrd")), a.status == 0);
}

VOLUMEN_TEST(TestLimits);
#include "tst_limits.moc"
