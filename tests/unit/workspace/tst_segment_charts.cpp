// Guards the charts of segments: one line each with its colour and name, in the displayed unit. Segments
// without values are reported, and CSV names each point.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "results/numbers/segment_charts.h"
#include "results/numbers/segments_over_time.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestSegmentCharts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void histogramsAreStaircases();
  void whatHasNoValuesIsTold();
  void csvNamesEachPoint();
  void meansOverTime();
  void timePointsAsJson();
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

// The second segment has no value at the middle time point, the third has none at all.
SegmentsOverTime threeOverTime() {
  return {{QStringLiteral("Time (s)"), {0, 2.5, 7}},
          "HU",
          {{StepValues{10, 1, 8, 12}, StepValues{20, 2, 15, 25}, StepValues{30, 3, 20, 40}},
           {StepValues{5, 0, 5, 5}, std::nullopt, StepValues{6, 0.5, 5, 7}},
           {std::nullopt, std::nullopt, std::nullopt}}};
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

void TestSegmentCharts::meansOverTime() {
  const std::vector<SegmentReport> all{segmentWith("One", {4}, {255, 0, 0}),
                                       segmentWith("Two", {8}, {0, 255, 0}),
                                       segmentWith("Three", {}, {0, 0, 255})};
  const std::vector<std::size_t> none, first{0}, turned{1, 0}, third{2};
  MeasuredChart chart = segmentsOverTimeChart(threeOverTime(), all, turned);
  QVERIFY(chart.marked);
  QCOMPARE(chart.xTitle, QStringLiteral("Time (s)"));
  QCOMPARE(chart.yTitle, QStringLiteral("Mean (HU)"));
  QVERIFY(
      (chart.lines == std::vector<std::vector<QPointF>>{{{0, 5}, {7, 6}}, {{0, 10}, {2.5, 20}, {7, 30}}}));
  QVERIFY((chart.sds == std::vector<std::vector<double>>{{0, 0.5}, {1, 2, 3}}));
  QCOMPARE(chart.looks.at(0).name, QStringLiteral("Two"));
  QCOMPARE(chart.looks.at(1).colour, QColor(255, 0, 0));
  QCOMPARE(chart.problem, QStringLiteral("Two: 1 of 3 volumes have no value here."));
  chart = segmentsOverTimeChart(threeOverTime(), all, third);
  QVERIFY(chart.lines.empty() && chart.looks.empty() && !chart.problem.isEmpty());
  QVERIFY(segmentsOverTimeChart(threeOverTime(), all, none).lines.empty());
  chart = segmentsOverTimeChart(threeOverTime(), all, first);
  QVERIFY(chart.problem.isEmpty());
  QCOMPARE(chartAsCsv(chart), QStringLiteral("\"Name\",\"Time (s)\",\"Mean (HU)\",\"SD\"\r\n"
                                             "One,0,10,1\r\nOne,2.5,20,2\r\nOne,7,30,3\r\n"));
}

void TestSegmentCharts::timePointsAsJson() {
  const auto full = timePointsJson(threeOverTime(), 0), gap = timePointsJson(threeOverTime(), 1);
  QCOMPARE(full.dump(), std::string(R"([{"at":0.0,"mean":10.0,"sd":1.0,"min":8.0,"max":12.0},)"
                                    R"({"at":2.5,"mean":20.0,"sd":2.0,"min":15.0,"max":25.0},)"
                                    R"({"at":7.0,"mean":30.0,"sd":3.0,"min":20.0,"max":40.0}])"));
  QCOMPARE(gap[1].dump(), std::string(R"({"at":2.5,"mean":null,"sd":null,"min":null,"max":null})"));
}

VOLUMEN_TEST(TestSegmentCharts);
#include "tst_segment_charts.moc"
