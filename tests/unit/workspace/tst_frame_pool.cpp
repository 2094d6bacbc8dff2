// Guards design.md 11 (frames in memory): what views show stays within reach, whatever the budget, and goes
// once nobody shows it; stored integers and reduced copies are counted as they are.
#include "tests/unit/suite.h"
#include "ui/data/frame_pool.h"

using namespace volumen;

class TestFramePool : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsShownStays();
  void aSmallerBudgetCountsAtOnce();
  void bytesAreThoseHeld();
};

namespace {

LoadedFramePtr frameOf(int index, glm::ivec2 size = {10, 10}) {
  Frame frame;
  frame.size = size;
  const auto pixels = std::size_t(size.x) * std::size_t(size.y);
  frame.values = {std::vector<std::uint16_t>(pixels, std::uint16_t(index)), 1, 0};
  frame.greys.emplace_back();
  const auto shown = shownFrame({}, {{}, index}, std::move(frame));
  if (!shown) throw std::runtime_error(shown.message());
  return *shown;
}

constexpr std::size_t bytes = 200;  // of a frame

}  // namespace

void TestFramePool::whatIsShownStays() {
  FramePool pool(bytes);
  std::vector<LoadedFramePtr> views;
  for (int n = 0; n < 3; ++n) pool.put(views.emplace_back(frameOf(n)));
  for (int n = 0; n < 3; ++n) QCOMPARE(pool.find({{}, n}), views[std::size_t(n)]);
  QCOMPARE(pool.bytes(), 3 * bytes);
  pool.put(frameOf(3));
  QVERIFY(pool.contains({{}, 3}));
  views[1].reset();
  pool.put(frameOf(4));
  QVERIFY(pool.contains({{}, 0}) && pool.contains({{}, 2}) && pool.contains({{}, 4}));
  QVERIFY(!pool.contains({{}, 1}) && !pool.contains({{}, 3}));
  views.clear();
  pool.put(frameOf(5));
  QCOMPARE(pool.heldOf({}, {}), std::vector<int>{5});
  QCOMPARE(pool.bytes(), bytes);
}

void TestFramePool::aSmallerBudgetCountsAtOnce() {
  FramePool pool(10 * bytes);
  for (int n = 0; n < 4; ++n) pool.put(frameOf(n));
  pool.setBudget(2 * bytes);
  QCOMPARE(pool.heldOf({}, {}), (std::vector<int>{2, 3}));
}

void TestFramePool::bytesAreThoseHeld() {
  QCOMPARE(frameOf(0)->bytes(), bytes);
  const std::size_t pixels = std::size_t(2048) * 2048;
  const LoadedFramePtr large = frameOf(0, {2048, 2048});
  QVERIFY2(large->bytes() > 2 * pixels, "its copies, too");
  QVERIFY(large->bytes() < pixels * 5 / 2);
}

VOLUMEN_TEST(TestFramePool);
#include "tst_frame_pool.moc"
