// Guards DESIGN 5, empty blocks: what counts as visible, and that an edit looks at the blocks once.
#include "tests/unit/suite.h"
#include "viewer/plan/visibility.h"

namespace {

using namespace volumen;

// Opacity from `foot` upwards.
TransferFunction risingFrom(float foot) {
  TransferFunction curve;
  curve.points = {{foot, {1, 1, 1}, 0}, {foot + 100, {1, 1, 1}, 0.5}};
  return curve;
}

BrickRanges oneBlock(float low, float high) { return {{1, 1, 1}, {low}, {high}}; }

VolumeFacts someFacts() {
  VolumeFacts facts;
  facts.bricks = std::make_shared<const BrickRanges>(BrickRanges{{2, 1, 1}, {0, 50}, {20, 200}});
  facts.visible = std::make_shared<VisibleBlocksMemo>();
  return facts;
}

}  // namespace

class TestVisibility : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aBlockIsVisible_data();
  void aBlockIsVisible();
  void ofManyBlocksEachCounts();
  void theSameCurveIsLookedAtOnce();
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

// More than are looked at together, and no whole number of such parts.
void TestVisibility::ofManyBlocksEachCounts() {
  BrickRanges bricks{{10007, 1, 1}, {}, {}};
  std::vector<std::uint8_t> expected;
  for (int n = 0; n < bricks.count.x; ++n) {
    bricks.low.push_back(float(n % 7));
    bricks.high.push_back(float(n % 7 + n % 11 * 10));
    expected.push_back(n % 7 + n % 11 * 10 > 50);
  }
  QCOMPARE(visibleBlocks(risingFrom(50.5f), bricks), expected);
}

void TestVisibility::theSameCurveIsLookedAtOnce() {
  const VolumeFacts facts = someFacts();
  const auto first = visibleBlocksOf(risingFrom(100), facts);
  QCOMPARE(first->flags, (std::vector<std::uint8_t>{0, 1}));
  QCOMPARE(first->count, std::int64_t(1));
  QCOMPARE(visibleBlocksOf(risingFrom(100), facts).get(), first.get());
  const auto edited = visibleBlocksOf(risingFrom(10), facts);
  QCOMPARE(edited->flags, (std::vector<std::uint8_t>{1, 1}));
  QCOMPARE(first->count, std::int64_t(1));  // who still holds the old answer keeps it
  VolumeFacts invented = facts;
  invented.visible = nullptr;
  QCOMPARE(visibleBlocksOf(risingFrom(10), invented)->flags, edited->flags);
}

VOLUMEN_TEST(TestVisibility);
#include "tst_visibility.moc"
