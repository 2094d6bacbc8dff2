// Guards design.md 4 (bench).
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestBenchCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void measuresEveryView();
  void aTableForPeople();
  void elevationRaisesTheCamera();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();
};

namespace {

Outcome runBench(const char* line) {
  return runProgram(QStringLiteral("bench ") + QString::fromLatin1(line));
}

QJsonArray viewsOf(const char* line) {
  return QJsonDocument::fromJson(runBench(line).out).object()[QStringLiteral("views")].toArray();
}

}  // namespace

void TestBenchCommand::measuresEveryView() {
  const QJsonArray views = viewsOf("phantom:ct-head:32 --size 32x32 --views 3 --rounds 2 --json");
  QCOMPARE(views.size(), 3);
  for (int n = 0; n < 3; ++n) {
    const QJsonObject view = views[n].toObject();
    QCOMPARE(view[QStringLiteral("angle")].toDouble(), 120. * n);
    QCOMPARE(view[QStringLiteral("framesMs")].toArray().size(), 2);
    QVERIFY(view[QStringLiteral("medianMs")].toDouble() >= view[QStringLiteral("minimumMs")].toDouble());
    QVERIFY(view[QStringLiteral("composited")].toDouble() > 0);
  }
}

void TestBenchCommand::aTableForPeople() {
  const Outcome done = runBench("phantom:sphere:16 --size 16x16 --step 1 --views 2 --rounds 1 --threads 1");
  QCOMPARE(done.status, 0);
  QVERIFY2(done.out.contains("16 x 16, step 1 voxel, 1 threads"), done.out);
  QVERIFY(done.out.contains("\n180 "));
  QVERIFY(done.err.isEmpty());
}

// Views the cube from its front and from nearly above an edge, which gives other paths through it.
void TestBenchCommand::elevationRaisesTheCamera() {
  const auto samples = [](const char* line) {
    return viewsOf(line)[0].toObject()[QStringLiteral("resampled")].toDouble();
  };
  const double level = samples("phantom:solid:16 --size 16x16 --step 1 --views 1 --rounds 1 --json");
  QCOMPARE(samples("phantom:solid:16 --size 16x16 --step 1 --views 1 --rounds 1 --json --elevation 0"),
           level);
  QVERIFY(samples("phantom:solid:16 --size 16x16 --step 1 --views 1 --rounds 1 --json --elevation 40") !=
          level);
}

void TestBenchCommand::wrongUsageIsRefused_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"", "phantom:sphere:16 --views 0", "phantom:sphere:16 --rounds 0", "phantom:sphere:16 --elevation 90",
        "phantom:sphere:16 --step 0", "phantom:sphere:16 -o /tmp/x", "--paper",
        "--paper -o /tmp/x --scene a.json", "--paper -o /tmp/x --step 1", "--paper -o /tmp/x --json",
        "phantom:sphere:16 --step 1 --quality high", "phantom:sphere:16 --size 3"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestBenchCommand::wrongUsageIsRefused() {
  QFETCH(QString, line);
  const Outcome done = runBench(qPrintable(line));
  QCOMPARE(done.status, 2);
  QVERIFY(!done.err.isEmpty() && done.out.isEmpty());
}

VOLUMEN_TEST(TestBenchCommand);
#include "tst_bench_command.moc"
