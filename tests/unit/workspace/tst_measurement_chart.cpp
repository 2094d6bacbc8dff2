// Guards the charts of values under a measurement: their contents, the time points of steps, and their CSV.
#include <cmath>
#include <limits>

#include "results/numbers/measurement_chart.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/workspace/measurements.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestMeasurementChart : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aProfileIsInShownUnits();
  void aProfileHasGapsOutside();
  void aHistogramIsAStaircase();
  void aCurveOverTime();
  void stepsStandAlongWhatVaries_data();
  void stepsStandAlongWhatVaries();
  void csvHoldsEveryPoint();
  void whichMeasurementsHaveCharts_data();
  void whichMeasurementsHaveCharts();
};

namespace {

// Returns 21 voxels of 2 mm along x, from -20 to 20 mm, with the values 0, 10, 20 ...
VolumePtr rampOfTens() {
  return volumeOf<float>({21, 3, 3}, glm::dmat3(2), [](dvec3 x) { return 10 * x.x; });
}

Measured lengthIn(double number, const char* unit) {
  Measured m;
  m.number = number;
  m.unit = unit;
  return m;
}

}  // namespace

void TestMeasurementChart::aProfileIsInShownUnits() {
  const std::vector<dvec3> line{{-20, 0, 0}, {20, 0, 0}};
  const MeasuredChart chart =
      profileChart(line, *rampOfTens(), {0.5, "SUVbw", {}}, Interpolation::linear, lengthIn(40, "mm"));
  QCOMPARE(chart.xTitle, QStringLiteral("Distance (mm)"));
  QCOMPARE(chart.yTitle, QStringLiteral("Value (SUVbw)"));
  QCOMPARE(chart.lines.size(), std::size_t(1));
  QVERIFY(chart.problem.isEmpty() && !chart.marked);
  for (const QPointF p : chart.lines[0]) QVERIFY(std::abs(p.y() - 2.5 * p.x()) < 1e-4);
  QCOMPARE(chart.lines[0].front().x(), 0.0);
  QVERIFY(std::abs(chart.lines[0].back().x() - 40) < 1e-9);
  QCOMPARE(profileChart(line, *rampOfTens(), {}, Interpolation::linear, lengthIn(20, "px")).xTitle,
           QStringLiteral("Distance (px)"));
}

// The line leaves the volume, enters it again, and leaves it.
void TestMeasurementChart::aProfileHasGapsOutside() {
  const std::vector<dvec3> line{{0, 0, 0}, {0, 20, 0}, {10, 20, 0}, {10, 0, 0}};
  const MeasuredChart chart =
      profileChart(line, *rampOfTens(), {1, "HU", {}}, Interpolation::linear, lengthIn(50, "mm"));
  QCOMPARE(chart.lines.size(), std::size_t(2));
  QVERIFY(chart.lines[0].back().x() <= 3 + 1e-9);  // half a voxel beyond the last centre
  QVERIFY(chart.lines[1].front().x() >= 47 - 1e-9);
  for (const QPointF p : chart.lines[1]) QVERIFY(std::abs(p.y() - 150) < 1e-3);
  const std::vector<dvec3> outside{{0, 50, 0}, {10, 50, 0}};
  const MeasuredChart none =
      profileChart(outside, *rampOfTens(), {1, "HU", {}}, Interpolation::linear, lengthIn(10, "mm"));
  QVERIFY(none.lines.empty() && !none.problem.isEmpty());
}

void TestMeasurementChart::aHistogramIsAStaircase() {
  Shape square{ShapeKind::rectangle, "", {{-4.5, -3, 0}, {4.5, 3, 0}}, ShapePlane{}, {}, {}};
  const MeasuredChart chart = histogramChart(square, *rampOfTens(), {1, "HU", {}}, QStringLiteral("Voxels"));
  QCOMPARE(chart.xTitle, QStringLiteral("Value (HU)"));
  QCOMPARE(chart.yTitle, QStringLiteral("Voxels"));
  QCOMPARE(chart.lines.size(), std::size_t(1));
  // Three voxels each of 80, 90, 100, 110 and 120. Bins have integer widths, and there are enough for one
  // value each.
  double area = 0;
  const std::vector<QPointF>& stairs = chart.lines[0];
  QCOMPARE(stairs.front().y(), 0.0);
  QCOMPARE(stairs.back().y(), 0.0);
  int high = 0;
  for (std::size_t n = 1; n < stairs.size(); ++n) {
    area += (stairs[n].x() - stairs[n - 1].x()) * stairs[n].y();
    high += stairs[n].x() > stairs[n - 1].x() && stairs[n].y() == 3;
  }
  QVERIFY(std::abs(area - 15) < 1e-9);
  QCOMPARE(high, 5);
  square.points = {{0.1, -0.1, 0}, {0.2, 0.1, 0}};
  QVERIFY(!histogramChart(square, *rampOfTens(), {1, "HU", {}}, {}).problem.isEmpty());
}

void TestMeasurementChart::aCurveOverTime() {
  const StepAxis axis{QStringLiteral("Time (s)"), {0, 2.5, 7}};
  const MeasuredChart chart = timeChart(axis, {1.5, std::nullopt, 3.0}, "HU");
  QVERIFY(chart.marked);
  QCOMPARE(chart.xTitle, QStringLiteral("Time (s)"));
  QCOMPARE(chart.yTitle, QStringLiteral("Mean (HU)"));
  QVERIFY((chart.lines == std::vector<std::vector<QPointF>>{{{0, 1.5}, {7, 3}}}));
  QCOMPARE(chart.problem, QStringLiteral("1 of 3 volumes have no value here."));
  QVERIFY(timeChart(axis, {1.0, 2.0, 3.0}, "HU").problem.isEmpty());
  QVERIFY(timeChart(axis, {std::nullopt, std::nullopt, std::nullopt}, "").lines.empty());
}

void TestMeasurementChart::stepsStandAlongWhatVaries_data() {
  QTest::addColumn<QStringList>("b");
  QTest::addColumn<QStringList>("echo");
  QTest::addColumn<QStringList>("time");
  QTest::addColumn<QString>("title");
  QTest::addColumn<QList<double>>("at");
  const QStringList none{{}, {}, {}};
  const auto list = [](const char* words) { return QString::fromLatin1(words).split(QLatin1Char(' ')); };
  const QList<double> numbers{1, 2, 3};
  QTest::newRow("nothing") << none << none << none << QStringLiteral("Volume") << numbers;
  QTest::newRow("b") << list("0 50 800") << none << list("101010 101020 101030")
                     << QStringLiteral("b (s/mm\u00b2)") << QList<double>{0, 50, 800};
  QTest::newRow("one b, several directions")
      << list("0 800 800") << none << none << QStringLiteral("Volume") << numbers;
  QTest::newRow("echoes") << none << list("4.6 9.2 13.8") << none << QStringLiteral("Echo time (ms)")
                          << QList<double>{4.6, 9.2, 13.8};
  QTest::newRow("times") << none << none << list("095958.5 100000 100100.25") << QStringLiteral("Time (s)")
                         << QList<double>{0, 1.5, 61.75};
  QTest::newRow("one time for all") << none << none << list("100000 100000 100000")
                                    << QStringLiteral("Volume") << numbers;
  QTest::newRow("times that go back")
      << none << none << list("100000 090000 100000") << QStringLiteral("Volume") << numbers;
  QTest::newRow("no times") << none << none << list("10 abcdef 100000") << QStringLiteral("Volume")
                            << numbers;
}

void TestMeasurementChart::stepsStandAlongWhatVaries() {
  QFETCH(QStringList, b);
  QFETCH(QStringList, echo);
  QFETCH(QStringList, time);
  std::vector<Series> series(3);
  std::vector<const Series*> steps;
  for (int n = 0; n < 3; ++n) {
    Series& step = series[std::size_t(n)];
    step.bValue = b[n].toStdString(), step.echoTime = echo[n].toStdString(),
    step.time = time[n].toStdString();
    steps.push_back(&step);
  }
  const StepAxis axis = stepAxisOf(steps);
  QTEST(axis.title, "title");
  QFETCH(QList<double>, at);
  QCOMPARE(axis.at.size(), std::size_t(3));
  for (int n = 0; n < 3; ++n) QVERIFY(std::abs(axis.at[std::size_t(n)] - at[n]) < 1e-9);
}

void TestMeasurementChart::csvHoldsEveryPoint() {
  MeasuredChart chart;
  chart.xTitle = QStringLiteral("Distance (mm)"), chart.yTitle = QStringLiteral("Value (\"a\", b)");
  chart.lines = {{{0, -5}, {1.0 / 3, 2.5}}, {{4, 1e-7}}};
  QCOMPARE(chartAsCsv(chart), QStringLiteral("\"Distance (mm)\",\"Value (\"\"a\"\", b)\"\r\n0,-5\r\n"
                                             "0.3333333,2.5\r\n,\r\n4,1e-07\r\n"));
}

void TestMeasurementChart::whichMeasurementsHaveCharts_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<bool>("steps");
  QTest::addColumn<QList<int>>("charts");
  using enum ChartKind;
  QTest::newRow("length") << int(ShapeKind::length) << true << QList<int>{int(profile)};
  QTest::newRow("polyline") << int(ShapeKind::polyline) << false << QList<int>{int(profile)};
  QTest::newRow("ellipse") << int(ShapeKind::ellipse) << false << QList<int>{int(histogram)};
  QTest::newRow("ellipse in time") << int(ShapeKind::ellipse) << true
                                   << QList<int>{int(histogram), int(overTime)};
  QTest::newRow("freehand in time") << int(ShapeKind::freehand) << true
                                    << QList<int>{int(histogram), int(overTime)};
  QTest::newRow("angle") << int(ShapeKind::angle) << true << QList<int>{};
  QTest::newRow("probe") << int(ShapeKind::probe) << true << QList<int>{};
  QTest::newRow("label") << int(ShapeKind::label) << true << QList<int>{};
}

void TestMeasurementChart::whichMeasurementsHaveCharts() {
  QFETCH(int, kind);
  QFETCH(bool, steps);
  QFETCH(QList<int>, charts);
  Workspace workspace;
  SeriesKey first;
  for (int n = 1; n <= (steps ? 2 : 1); ++n) {
    Series series;
    series.path = "four.nrrd", series.id = "four#" + std::to_string(n), series.format = "NRRD";
    workspace.series.editOrAdd(keyOf(series)).series = std::make_shared<const Series>(series);
    if (n == 1) first = keyOf(series);
  }
  Measurement m{1, first, {}, {}};
  m.shape.kind = ShapeKind(kind);
  QList<int> found;
  for (const ChartKind chart : chartsOf(workspace, m)) found << int(chart);
  QCOMPARE(found, charts);
  m.shape.frame = ShapeFrame{"1.2.3", 0};
  for (const ChartKind chart : chartsOf(workspace, m)) QVERIFY(chart != ChartKind::overTime);
}

VOLUMEN_TEST(TestMeasurementChart);
#include "tst_measurement_chart.moc"
