// Guards the value ranges that spans of a curve offer for segments: the visible values, as displayed.
#include <cmath>

#include "results/text/value_text.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/workspace/curve_spans.h"
#include "viewer/scene/visible_range.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a CT, or a PET in which 1000 Bq/ml are 5 SUVbw.
LoadedSeries seriesFrom(double low, double high, bool pet = false) {
  LoadedSeries series;
  series.histogram = {.low = low, .high = high, .counts = std::vector<std::int64_t>(10, 1)};
  series.series.modality = pet ? "PT" : "CT";
  series.series.unit = pet ? "Bq/ml" : "HU";
  if (pet) series.series.suv.bodyWeight = 0.005;
  return series;
}

TransferFunction curveOf(std::vector<std::pair<float, double>> points) {
  TransferFunction curve;
  curve.points.clear();
  for (const auto& [value, opacity] : points) curve.points.push_back({value, glm::dvec3(1), opacity});
  return curve;
}

}  // namespace

class TestCurveSpans : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void spansOfferWhatTheyShow_data();
  void spansOfferWhatTheyShow();
  void narrowOnesAndThoseBeside();
  void whatFollowsHasItsSpan();
  void rangesHaveNames();
};

void TestCurveSpans::spansOfferWhatTheyShow_data() {
  QTest::addColumn<bool>("pet");
  QTest::newRow("CT") << false;
  QTest::newRow("PET in SUV") << true;
}

// In random cases, ranges are within the span and the series. They are nearer to its ends than one unit of
// the last displayed digit.
void TestCurveSpans::spansOfferWhatTheyShow() {
  QFETCH(bool, pet);
  const Seeds seeds = seedsOf(5000, 50000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const LoadedSeries series = seriesFrom(pet ? 0 : -1000, 3000, pet);
    std::vector<float> values;
    for (int n = 2 + chance.below(6); n > 0; --n) values.push_back(float(chance.between(-1500, 3500)));
    std::ranges::sort(values);
    std::vector<std::pair<float, double>> points;
    for (const float value : values) points.emplace_back(value, chance.oneIn(2) ? 0 : chance.share());
    const TransferFunction curve = curveOf(points);
    const std::vector<ValueRange> spans = visibleSpans(curve);
    const double digit = std::pow(10.0, -valueDecimals(series)) / shownScale(series.series).factor;
    for (int n = 0; n < int(spans.size()); ++n) {
      const double low = std::max(spans[std::size_t(n)].low, series.histogram.low),
                   high = std::min(spans[std::size_t(n)].high, series.histogram.high);
      if (high - low < 3 * digit) continue;  // outside the series, or narrower than its digits
      const auto range = rangeOfSpan(curve, n, series);
      QVERIFY(range.has_value());
      QVERIFY2(range->low >= low - 1e-9 && range->low < low + 1.001 * digit,
               qPrintable(QString::number(seed)));
      QVERIFY2(range->high <= high + 1e-9 && range->high > high - 1.001 * digit,
               qPrintable(QString::number(seed)));
    }
    QVERIFY(!rangeOfSpan(curve, int(spans.size()), series) && !rangeOfSpan(curve, -1, series));
  }
}

void TestCurveSpans::narrowOnesAndThoseBeside() {
  const LoadedSeries series = seriesFrom(-1000, 3000);
  const auto narrow = rangeOfSpan(curveOf({{300.02f, 0}, {300.05f, 1}, {300.07f, 0}}), 0, series);
  QVERIFY(narrow && narrow->low > 300.02 - 1e-4 && narrow->low < narrow->high);
  QVERIFY(narrow->high < 300.07 + 1e-4);
  const auto above = rangeOfSpan(curveOf({{3000.01f, 0}, {3500, 1}}), 0, series);
  QVERIFY(above && above->low > 3000 && above->high == above->low);
  const auto below = rangeOfSpan(curveOf({{-2000, 1}, {-1000.01f, 0}}), 0, series);
  QVERIFY(below && below->high < -1000 && below->high == below->low);
}

void TestCurveSpans::whatFollowsHasItsSpan() {
  const LoadedSeries series = seriesFrom(-1000, 3000);
  const TransferFunction two = curveOf({{100, 0}, {150, 1}, {200, 0}, {300, 0}, {400, 1}}),
                         one = curveOf({{100, 0}, {400, 1}});
  Segment segment;
  segment.range = ValueRange{1, 2};
  QVERIFY(!rangeFollowed(segment, two, series));
  segment.span = CurveSpan{1, 2};
  QVERIFY(rangeFollowed(segment, two, series) == rangeOfSpan(two, 1, series));
  QVERIFY(!rangeFollowed(segment, one, series));
  segment.span = CurveSpan{0, 1};
  QVERIFY(rangeFollowed(segment, one, series) == rangeOfSpan(one, 0, series));
}

void TestCurveSpans::rangesHaveNames() {
  QCOMPARE(nameOfRange({150, 3000}, seriesFrom(-1000, 3000).series), std::string("150 to 3000 HU"));
  QCOMPARE(nameOfRange({500, 1200}, seriesFrom(0, 3000, true).series), std::string("2.5 to 6 SUVbw"));
}

VOLUMEN_TEST(TestCurveSpans);
#include "tst_curve_spans.moc"
