// Guards design.md 5, empty blocks: which blocks count as visible, and that views with the same curve count
// them once.
#include <algorithm>

#include "tests/unit/suite.h"
#include "viewer/plan/visibility.h"

namespace {

using namespace volumen;

// Returns a curve whose opacity rises from `foot`.
TransferFunction risingFrom(float foot) {
  TransferFunction curve;
  curve.points = {{foot, {1, 1, 1}, 0}, {foot + 100, {1, 1, 1}, 0.5}};
  return curve;
}

BlockRanges oneBlock(float low, float high) { return blockRangesOf(4, {1, 1, 1}, {low}, {high}); }

}  // namespace

class TestVisibility : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aBlockIsVisible_data();
  void aBlockIsVisible();
  void ofManyBlocksEachCounts();
  void spansAreMetFromBothSides();
  void whereThereAreNoBlocksNoneIsVisible();
};

void TestVisibility::aBlockIsVisible_data() {
  QTest::addColumn<double>("foot");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<double>("rounding");
  QTest::addColumn<bool>("visible");
  const auto row = [](const char* name, double foot, double low, double high, double rounding, bool visible) {
    QTest::newRow(name) << foot << low << high << rounding << visible;
  };
  row("far below the curve", 100, -50, 50, 0, false);
  row("reaches into the curve", 100, -50, 101, 0, true);
  row("ends at the curve's foot: interpolation may round across it", 100, -50, 100, 0, true);
  row("constant at the curve's foot: rescaling may round across it", 100, 100, 100, 0, true);
  row("a constant 0 at the curve's foot is exact", 0, 0, 0, 0, false);
  row("rises from 0 at the curve's foot", 0, 0, 1e-30, 0, true);
  row("ends at 0, the curve's foot", 0, -1, 0, 0, true);
  row("stored values may be off by more than is missing", 100, 0, 99, 1.5, true);
  row("stored values may be off by less than is missing", 100, 0, 98, 1.5, false);
}

void TestVisibility::aBlockIsVisible() {
  QFETCH(double, foot);
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(double, rounding);
  QFETCH(bool, visible);
  const auto flags = visibleBlocks(risingFrom(float(foot)), oneBlock(float(low), float(high)), rounding);
  QCOMPARE(flags, std::vector<std::uint8_t>{visible});
}

// The number of blocks exceeds one batch and is no multiple of it.
void TestVisibility::ofManyBlocksEachCounts() {
  std::vector<float> low, high;
  std::vector<std::uint8_t> expected;
  constexpr int count = 40007;
  for (int n = 0; n < count; ++n) {
    low.push_back(float(n % 7));
    high.push_back(float(n % 7 + n % 11 * 10));
    expected.push_back(n % 7 + n % 11 * 10 > 50);
  }
  const BlockRanges blockRanges = blockRangesOf(4, {count, 1, 1}, low, high);
  QCOMPARE(visibleBlocks(risingFrom(50.5f), blockRanges), expected);
  QCOMPARE(visibleBlockCount(risingFrom(50.5f), blockRanges),
           std::count(expected.begin(), expected.end(), 1));
}

// Exactly the bounds that overlap one of the two spans of visible values are visible.
void TestVisibility::spansAreMetFromBothSides() {
  TransferFunction curve;
  curve.points = {{100, {}, 0}, {150, {}, 1}, {200, {}, 0}, {300, {}, 0}, {350, {}, 1}, {400, {}, 0}};
  std::vector<float> low, high;
  for (int a = 0; a < 500; a += 10)
    for (int b = a; b < 500; b += 10) low.push_back(float(a)), high.push_back(float(b));
  const auto flags = visibleBlocks(curve, blockRangesOf(4, {int(low.size()), 1, 1}, low, high));
  for (std::size_t n = 0; n < low.size(); ++n) {
    const bool meets = (low[n] <= 200 && high[n] >= 100) || (low[n] <= 400 && high[n] >= 300);
    QVERIFY2(flags[n] == meets, qPrintable(QStringLiteral("%1 .. %2").arg(low[n]).arg(high[n])));
  }
}

void TestVisibility::whereThereAreNoBlocksNoneIsVisible() {
  QCOMPARE(visibleBlockCount(risingFrom(100), blockRangesOf(4, {0, 1, 1}, {}, {})), std::int64_t(0));
}

VOLUMEN_TEST(TestVisibility);
#include "tst_visibility.moc"
