// Guards the options of design.md 6 that change the curve: table size and low-opacity threshold.
#include <cmath>

#include "tests/unit/suite.h"
#include "viewer/scene/curve_changes.h"

using namespace volumen;

class TestCurveChanges : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aTableHoldsItsNearestEntry_data();
  void aTableHoldsItsNearestEntry();
  void aTableOfEqualEntriesIsShort();
  void faintIsCutWhereTheCurveCrosses_data();
  void faintIsCutWhereTheCurveCrosses();
};

namespace {

// Evaluates the curve exactly by picture.md 4.
CurvePoint at(const TransferFunction& curve, double value) {
  const auto& p = curve.points;
  CurvePoint out = p.front();
  for (std::size_t n = 0; n < p.size(); ++n) {
    if (double(p[n].value) <= value) out = p[n];
    if (n + 1 < p.size() && double(p[n].value) <= value && value < double(p[n + 1].value)) {
      const double s = (value - p[n].value) / (double(p[n + 1].value) - p[n].value);
      out.opacity = p[n].opacity + s * (p[n + 1].opacity - p[n].opacity);
      out.colour = p[n].colour + s * (p[n + 1].colour - p[n].colour);
    }
  }
  return out;
}

TransferFunction curveOf(std::vector<CurvePoint> points) { return {1.0, std::move(points), {}}; }

}  // namespace

void TestCurveChanges::aTableHoldsItsNearestEntry_data() {
  QTest::addColumn<int>("entries");
  for (const int n : {2, 3, 17, 256}) QTest::addRow("%d entries", n) << n;
}

void TestCurveChanges::aTableHoldsItsNearestEntry() {
  QFETCH(int, entries);
  const TransferFunction curve =
      curveOf({{-50, {1, 0, 0}, 0}, {20, {0, 1, 0}, 0.3}, {20, {0, 0, 1}, 0.9}, {90, {1, 1, 1}, 0.1}});
  const TransferFunction table = tabulated(curve, entries, {-100, 100});
  const double width = 200.0 / (entries - 1);
  for (double value = -99.83; value < 100; value += 1.37) {
    const double entry = std::round((value + 100) / width);
    // Within float rounding of the border between two entries, either is right.
    if (std::abs(std::abs((value + 100) / width - entry) - 0.5) < 1e-5) continue;
    const CurvePoint expected = at(curve, float(-100 + entry * width)), found = at(table, value);
    QVERIFY(std::abs(found.opacity - expected.opacity) < 1e-9);
    QVERIFY(std::abs(found.colour.g - expected.colour.g) < 1e-9);
  }
}

void TestCurveChanges::aTableOfEqualEntriesIsShort() {
  const TransferFunction table =
      tabulated(curveOf({{0, {1, 1, 1}, 0}, {1, {1, 1, 1}, 0.5}}), 65536, {-1000, 0});
  QCOMPARE(table.points.size(), std::size_t(1));
  QCOMPARE(table.points[0].opacity, 0.0);
}

void TestCurveChanges::faintIsCutWhereTheCurveCrosses_data() {
  QTest::addColumn<double>("value");
  QTest::addColumn<double>("opacity");
  // The curve rises from 0 to 0.4 over 0 .. 40, falls to 0 at 80, jumps to 0.05 at 100 and to 0.5 at 120.
  QTest::newRow("below the crossing") << 9.9 << 0.;
  QTest::newRow("above the crossing, as it was") << 10.5 << 0.105;
  QTest::newRow("at the top") << 40. << 0.4;
  QTest::newRow("before the falling crossing") << 69. << 0.11;
  QTest::newRow("behind the falling crossing") << 71. << 0.;
  QTest::newRow("a faint plateau") << 110. << 0.;
  QTest::newRow("behind a step over the threshold") << 120. << 0.5;
}

void TestCurveChanges::faintIsCutWhereTheCurveCrosses() {
  QFETCH(double, value);
  QFETCH(double, opacity);
  const TransferFunction curve = curveOf({{0, {1, 1, 1}, 0},
                                          {40, {1, 1, 1}, 0.4},
                                          {80, {1, 1, 1}, 0},
                                          {100, {1, 1, 1}, 0},
                                          {100, {1, 1, 1}, 0.05},
                                          {120, {1, 1, 1}, 0.05},
                                          {120, {1, 1, 1}, 0.5}});
  QVERIFY(std::abs(at(withoutFaint(curve, 0.1), value).opacity - opacity) < 1e-9);
  QVERIFY(withoutFaint(curve, 0) == curve);
}

VOLUMEN_TEST(TestCurveChanges);
#include "tst_curve_changes.moc"
