// Guards picture.md 4 (points of one value) for restricting a curve to a range, and design.md 8 (segmenting
// the visible range).
#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/suite.h"
#include "viewer/scene/scene_json.h"
#include "viewer/scene/visible_range.h"

using namespace volumen;

class TestVisibleRange : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void opacityStaysInsideAndIsZeroOutside_data();
  void opacityStaysInsideAndIsZeroOutside();
  void restrictedCurvesAreValid();
  void spansOfKnownCurves_data();
  void spansOfKnownCurves();
  void spansHoldExactlyTheVisibleValues();
};

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

// Evaluates picture.md 4 literally: linear between neighbours, constant outside, last of equal points.
double opacityAt(const TransferFunction& curve, double value) {
  const auto& p = curve.points;
  if (value < double(p.front().value)) return p.front().opacity;
  std::size_t n = 0;
  while (n + 1 < p.size() && double(p[n + 1].value) <= value) ++n;
  if (n + 1 == p.size()) return p[n].opacity;
  const double f = (value - double(p[n].value)) / (double(p[n + 1].value) - double(p[n].value));
  return p[n].opacity + f * (p[n + 1].opacity - p[n].opacity);
}

TransferFunction curveOf(const std::vector<std::pair<float, double>>& points) {
  TransferFunction curve;
  curve.points.clear();
  for (const auto& [value, opacity] : points) curve.points.push_back({value, {0.5, 0.25, 1}, opacity});
  return curve;
}

const TransferFunction ramp = curveOf({{150, 0}, {400, 0.8}});
const TransferFunction steps = curveOf({{0, 0.5}, {0, 0}, {10, 0}, {10, 0.4}, {20, 0.6}, {20, 0.1}});
const TransferFunction flat = curveOf({{7, 0.3}});

TransferFunction randomCurve(std::mt19937& bits) {
  std::vector<std::pair<float, double>> points(1 + bits() % 8);
  for (auto& [value, opacity] : points) {
    value = float(int(bits() % 12)) - 5.5f;  // avoids 0, beside which doubles cannot resolve values
    opacity = bits() % 2 ? 0 : double(bits() % 1000) / 1000;
  }
  std::sort(points.begin(), points.end(), [](auto a, auto b) { return a.first < b.first; });
  if (bits() % 2) points.push_back({std::nextafter(points.back().first, largest), 0.5});
  return curveOf(points);
}

// Returns values around every point and between them, where something may change.
std::vector<float> interestingValues(const TransferFunction& curve, std::vector<float> more = {}) {
  for (const CurvePoint& p : curve.points) more.push_back(p.value);
  std::vector<float> values{-largest, -1e6f, -0.0f, 0.5f, 1e6f, largest};
  for (float v : more)
    for (float w : {std::nextafter(v, -largest), v, std::nextafter(v, largest), v + 0.5f, v - 0.5f})
      values.push_back(w);
  return values;
}

}  // namespace

void TestVisibleRange::opacityStaysInsideAndIsZeroOutside_data() {
  QTest::addColumn<TransferFunction>("curve");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  const auto rows = [](const char* name, const TransferFunction& curve, double a, double b) {
    QTest::addRow("%s, inside", name) << curve << a << b;
    QTest::addRow("%s, one value", name) << curve << a << a;
    QTest::addRow("%s, from -inf", name) << curve << -infinity << a;
    QTest::addRow("%s, to inf", name) << curve << b << infinity;
    QTest::addRow("%s, everything", name) << curve << -infinity << infinity;
    QTest::addRow("%s, beyond the points", name) << curve << -1000. << 1000.;
    QTest::addRow("%s, no float32 in it", name) << curve << a + 1e-12 << a + 2e-12;
    QTest::addRow("%s, upside down", name) << curve << b << a;
    QTest::addRow("%s, ends that are no float32", name) << curve << a + 1e-9 << b + 1e-9;
  };
  rows("ramp", ramp, 200, 300);
  rows("ramp from its foot", ramp, 150, 400);
  rows("steps at its steps", steps, 10, 20);
  rows("steps between them", steps, 5, 15);
  rows("flat", flat, 7, 9);
}

void TestVisibleRange::opacityStaysInsideAndIsZeroOutside() {
  QFETCH(TransferFunction, curve);
  QFETCH(double, low);
  QFETCH(double, high);
  const TransferFunction restricted = restrictedTo(curve, {low, high});
  QCOMPARE(restricted.unitDistance, curve.unitDistance);
  for (float v : interestingValues(curve, {float(low), float(high)})) {
    if (!std::isfinite(v)) continue;
    const bool inside = low <= double(v) && double(v) <= high;
    const double opacity = opacityAt(restricted, double(v));
    if (inside)
      QVERIFY2(std::abs(opacity - opacityAt(curve, double(v))) < 1e-12, qPrintable(QString::number(v)));
    else
      QVERIFY2(opacity == 0, qPrintable(QString::number(v)));
  }
}

void TestVisibleRange::restrictedCurvesAreValid() {
  std::mt19937 bits(3);
  for (int n = 0; n < 1000; ++n) {
    Scene scene;
    const TransferFunction curve = randomCurve(bits);
    const double low = double(int(bits() % 40)) / 2 - 10, high = low + double(bits() % 10) - 1;
    scene.transferFunction = restrictedTo(curve, {low, high});
    QVERIFY(validateScene(scene).ok());
    QVERIFY(scene.transferFunction.points.size() <= curve.points.size() + 4);
    for (float v : interestingValues(curve, {float(low), float(high)})) {
      const bool inside = low <= double(v) && double(v) <= high;
      const double expected = inside ? opacityAt(curve, double(v)) : 0;
      QVERIFY(std::abs(opacityAt(scene.transferFunction, double(v)) - expected) < 1e-12);
    }
  }
}

void TestVisibleRange::spansOfKnownCurves_data() {
  QTest::addColumn<TransferFunction>("curve");
  QTest::addColumn<std::vector<double>>("spans");
  const double justAbove150 = double(std::nextafter(150.f, largest));
  const double justBelow0 = double(std::nextafter(0.f, -largest));
  QTest::newRow("ramp") << ramp << std::vector{justAbove150, infinity};
  QTest::newRow("flat") << flat << std::vector{-infinity, infinity};
  QTest::newRow("nothing") << curveOf({{1, 0}, {2, 0}}) << std::vector<double>{};
  QTest::newRow("steps") << steps << std::vector{-infinity, justBelow0, 10.0, infinity};
  QTest::newRow("spike on one value")
      << curveOf({{5, 0}, {5, 1}, {std::nextafter(5.f, largest), 0}}) << std::vector{5.0, 5.0};
  QTest::newRow("two hills that touch at a zero")
      << curveOf({{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}})
      << std::vector{double(std::nextafter(0.f, 1.f)), double(std::nextafter(2.f, 0.f)),
                     double(std::nextafter(2.f, 3.f)), double(std::nextafter(4.f, 0.f))};
}

void TestVisibleRange::spansOfKnownCurves() {
  QFETCH(TransferFunction, curve);
  QFETCH(std::vector<double>, spans);
  std::vector<double> found;
  for (const ValueRange& r : visibleSpans(curve)) found.insert(found.end(), {r.low, r.high});
  QCOMPARE(found, spans);
}

void TestVisibleRange::spansHoldExactlyTheVisibleValues() {
  std::mt19937 bits(5);
  for (int n = 0; n < 2000; ++n) {
    const TransferFunction curve = randomCurve(bits);
    const auto spans = visibleSpans(curve);
    for (std::size_t s = 1; s < spans.size(); ++s) QVERIFY(spans[s - 1].high < spans[s].low);
    for (float v : interestingValues(curve)) {
      const bool inside = std::any_of(spans.begin(), spans.end(), [&](const ValueRange& r) {
        return r.low <= double(v) && double(v) <= r.high;
      });
      QCOMPARE(inside, opacityAt(curve, double(v)) > 0);
    }
  }
}

VOLUMEN_TEST(TestVisibleRange);
#include "tst_visible_range.moc"
