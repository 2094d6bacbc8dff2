// Guards the charts of segments: one line each, in its colour and by its name, in the unit that is shown;
// what has no values is told; CSV names each point.
#include <algorithm>

#include "tests/unit/suite.h"
#include "ui/workspace/segment_charts.h"

using namespace volumen;

class TestSegmentCharts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void histogramsAreStaircases();
  void whatHasNoValuesIsTold();
  void csvNamesEachPoint();
};

namespace {

SegmentReport segmentWith(const char* name, const std::vector<double>& whole, glm::u8vec3 colour) {
  SegmentReport report;
  report.segment = {.number = 1, .label = name, .colour = colour};
  report.voxels = report.values.voxels = std::int64_t(whole.size());
  if (whole.empty()) return report;
  const auto [least, most] = std::ranges::minmax(whole);
  report.values.histogram = binsFor({least, most}, true);
  for (const double value : whole) report.values.histogram.add(value);
  return report;
}

}  // namespace

void TestSegmentCharts::histogramsAreStaircases() {
  const std::vector<SegmentReport> two{segmentWith("One", {4, 5, 5}, {255, 0, 0}),
                                       segmentWith("Two", {8}, {0, 255, 0})};
  const MeasuredChart chart = segmentHistograms(two, {2, "SUVbw", {}});
  QCOMPARE(chart.xTitle, QStringLiteral("Value (SUVbw)"));
  QCOMPARE(chart.yTitle, QStringLiteral("Voxels"));
  QVERIFY((chart.lines[0] == std::vector<QPointF>{{7, 0}, {7, 1}, {9, 1}, {9, 2}, {11, 2}, {11, 0}}));
  QVERIFY((chart.lines[1] == std::vector<QPointF>{{15, 0}, {15, 1}, {17, 1}, {17, 0}}));
  QVERIFY((chart.looks == std::vector<ChartLineLook>{{QStringLiteral("One"), QColor(255, 0, 0)},
                                                     {QStringLiteral("Two"), QColor(0, 255, 0)}}));
  QVERIFY(chart.problem.isEmpty());
}

void TestSegmentCharts::whatHasNoValuesIsTold() {
  const std::vector<SegmentReport> two{segmentWith("Empty", {}, {255, 0, 0}),
                                       segmentWith("Two", {8}, {0, 255, 0})};
  const MeasuredChart chart = segmentHistograms(two, {});
  QCOMPARE(chart.lines.size(), std::size_t(1));
  QVERIFY((chart.looks == std::vector<ChartLineLook>{{QStringLiteral("Two"), QColor(0, 255, 0)}}));
  QCOMPARE(chart.problem, QStringLiteral("Without values: Empty"));
  QVERIFY(segmentHistograms({}, {}).lines.empty());
}

void TestSegmentCharts::csvNamesEachPoint() {
  const std::vector<SegmentReport> two{segmentWith("=1, 2", {4}, {255, 0, 0}),
                                       segmentWith("Two", {8}, {0, 255, 0})};
  QCOMPARE(chartAsCsv(segmentHistograms(two, {})),
           QStringLiteral("\"Name\",\"Value\",\"Voxels\"\r\n"
                          "\"'=1, 2\",3.5,0\r\n\"'=1, 2\",3.5,1\r\n\"'=1, 2\",4.5,1\r\n\"'=1, 2\",4.5,0\r\n"
                          ",,\r\n"
                          "Two,7.5,0\r\nTwo,7.5,1\r\nTwo,8.5,1\r\nTwo,8.5,0\r\n"));
}

VOLUMEN_TEST(TestSegmentCharts);
#include "tst_segment_charts.moc"
