// Guards design.md 11 (frames in memory): what views show stays within reach,
// whatever the budget, and goes once nobody shows it; stored integers and
// reduced copies are counted as they are.
#include "tests/unit/suite.h"
#include "ui/data/frame_pool.h"
#include "ui/data/series_pool.h"

using namespace volumen;

class TestFramePool : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsShownStays();
  void aSmallerBudgetCountsAtOnce();
  void bytesAreThoseHeld();
  void framesGiveWayWithinTheBudgetOfSeries();
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

void TestFramePool::framesGiveWayWithinTheBudgetOfSeries() {
  FramePool frames(10 * bytes);
  SeriesPool series(4 * bytes);
  series.host(&frames, {[&] { return frames.bytes(); }, [&](std::size_t most) { frames.dropBeyond(most); }});
  const LoadedFramePtr seen = frameOf(0);
  frames.put(seen);
  for (int n = 1; n < 6; ++n) frames.put(frameOf(n));
  QCOMPARE(series.counted(), 6 * bytes);
  series.fit();
  QCOMPARE(series.counted(), 4 * bytes);
  QCOMPARE(frames.heldOf({}, {}), (std::vector<int>{0, 3, 4, 5}));
  const int onScreen = 0;
  series.count(&onScreen, 2 * bytes);
  QCOMPARE(frames.heldOf({}, {}), (std::vector<int>{0, 5}));
  series.count(&onScreen, 5 * bytes);
  QCOMPARE(frames.heldOf({}, {}), std::vector<int>{0});
  series.count(&onScreen, 0);
  series.leave(&frames);
  QCOMPARE(series.counted(), std::size_t(0));
}

VOLUMEN_TEST(TestFramePool);
#include "tst_frame_pool.moc"
