// Guards design.md 11: what is computed once for a volume is shared by all views that draw it, and released
// with it.
#include "tests/ui/slow_renderer.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/scene/presets.h"

using namespace volumen;
using namespace volumen::tests;

class TestSharedVoxels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allThatDrawAVolumeShareItsVoxels();
  void aVolumeShownAgainIsNotComputedAgain();
  void voxelsGoWithTheirVolume();
  void picturesOfSharedVoxelsAreTheSame();
  void whatWasComputedGoesBeforeSeries();
  void whatIsInUseStays();
  void roomIsMadeBeforeItIsTaken_data();
  void roomIsMadeBeforeItIsTaken();
  void shortMemoryIsASentence();
};

namespace {

/// A plain renderer that keeps weak references to its volumes. A raw pointer could occur twice.
struct Recorder {
  SlowRenderer renderer;
  std::vector<std::weak_ptr<StoredVoxels>> made;  // written by the render thread until it waits

  MakeDraw make() {
    return [this](const VoxelsPtr& voxels) {
      voxels->facts();
      made.push_back(voxels);
      return renderer.make()(voxels);
    };
  }
};

}  // namespace

void TestSharedVoxels::allThatDrawAVolumeShareItsVoxels() {
  Recorder recorder;
  Watched w(recorder.make());
  for (ViewId view = 0; view < 4; ++view) {
    w.service.show(view, w.volume);
    const int number = w.service.request(view, greyScene(0.5), {16, 12});
    QTRY_COMPARE(w.answerTo(number), Answer::drawn);
  }
  QCOMPARE(recorder.made.size(), std::size_t(4));
  // Saves a picture of a volume that no view shows any more.
  for (ViewId view = 0; view < 4; ++view) w.service.show(view, nullptr);
  QSignalSpy ready(&w.service, &DrawService::pictureReady);
  w.service.requestPicture(w.volume, greyScene(0.5), ofSize(8, 8));
  QTRY_COMPARE(ready.count(), 1);
  QCOMPARE(recorder.made.size(), std::size_t(5));
  const VoxelsPtr shared = recorder.made[0].lock();
  QVERIFY(shared && shared->volume() == w.volume);
  for (const auto& voxels : recorder.made) QCOMPARE(voxels.lock(), shared);
}

void TestSharedVoxels::aVolumeShownAgainIsNotComputedAgain() {
  Recorder recorder;
  Watched w(recorder.make());
  const VolumePtr other = smallVolume(2);
  for (const VolumePtr& volume : {w.volume, other, w.volume}) {
    w.service.show(0, volume);
    const int number = w.service.request(0, greyScene(0.5), {16, 12});
    QTRY_COMPARE(w.answerTo(number), Answer::drawn);
  }
  QCOMPARE(recorder.made.size(), std::size_t(3));
  const VoxelsPtr first = recorder.made[0].lock();
  QVERIFY(first && first->volume() == w.volume);
  QCOMPARE(recorder.made[2].lock(), first);
  QVERIFY(recorder.made[1].lock() != first);
}

void TestSharedVoxels::voxelsGoWithTheirVolume() {
  Recorder recorder;
  Watched w(recorder.make());
  VolumePtr volume = smallVolume(2);
  const std::weak_ptr<const Volume> watched = volume;
  w.service.show(0, volume);
  const int number = w.service.request(0, greyScene(0.5), {16, 12});
  QTRY_COMPARE(w.answerTo(number), Answer::drawn);
  w.pictures.clear();
  w.service.show(0, nullptr);
  QTest::qWait(50);
  QVERIFY2(!recorder.made.back().expired(), "somebody holds the volume, who may show it again");
  // The service is not told that the volume is gone, but notices.
  volume.reset();
  QTRY_VERIFY(watched.expired());
  QVERIFY(recorder.made.back().expired());
}

void TestSharedVoxels::picturesOfSharedVoxelsAreTheSame() {
  const VolumePtr head = *makePhantom("ct-head:48");
  Scene scene = *presetScene("auto", *head);
  scene.camera = fitCamera(Camera{}, head->geometry(), 1);
  const auto voxels = std::make_shared<StoredVoxels>(head);
  const Draw first = drawWithCaches(voxels), second = drawWithCaches(voxels);
  const VolumeFacts* facts = &voxels->facts();
  const auto alone = drawWithCaches(std::make_shared<StoredVoxels>(head))(scene, ofSize(64, 64), {});
  QVERIFY(alone.ok());
  const std::int16_t* gradients = nullptr;
  for (const Draw& draw : {first, second}) {
    const auto drawn = draw(scene, ofSize(64, 64), {});
    QVERIFY(drawn.ok());
    QVERIFY(drawn->picture.rgba == alone->picture.rgba);
    QVERIFY2(drawn->plan.gradients && drawn->plan.bits == 16, "or other voxels are to be looked at");
    const std::int16_t* now = voxels->gradientsIn16(drawn->plan.gradientOperator).xyzd.data();
    QVERIFY2(!gradients || gradients == now, "computed once");
    gradients = now;
  }
  QCOMPARE(&voxels->facts(), facts);
}

namespace {

constexpr GradientOperator sobel = GradientOperator::sobel;

std::size_t valueBytes() { return ballSeries()->volume->bytes(); }

// A pool with series that were needed in this order, and what was computed of each.
struct Filled {
  std::vector<PoolKey> keys;
  std::size_t computedBytes = 0;  // of each

  Filled(SeriesPool& pool, int count) {
    for (int n = 0; n < count; ++n) {
      const LoadedSeriesPtr series = ballSeries();
      keys.push_back({keyOf(series->series), {}});
      pool.put(keys.back(), series);
      const VoxelsPtr voxels = pool.voxelsOf(series->volume);
      voxels->gradientsIn16(sobel);
      computedBytes = voxels->bytes();
    }
  }
};

int heldOf(const SeriesPool& pool, const Filled& filled) {
  return int(
      std::ranges::count_if(filled.keys, [&](const PoolKey& key) { return pool.peek(key) != nullptr; }));
}

}  // namespace

void TestSharedVoxels::whatWasComputedGoesBeforeSeries() {
  SeriesPool pool(std::size_t(1) << 30);
  const Filled filled(pool, 4);
  QVERIFY2(filled.computedBytes >= 4 * valueBytes(), "gradients take four times as much as values");
  const std::size_t series = 4 * valueBytes();
  QCOMPARE(pool.counted(), series + 4 * filled.computedBytes);
  pool.setBudget(series + 2 * filled.computedBytes);
  QCOMPARE(pool.counted(), series + 2 * filled.computedBytes);
  QCOMPARE(heldOf(pool, filled), 4);
  QVERIFY2(pool.voxelsOf(pool.peek(filled.keys[3])->volume)->bytes() > 0, "needed last");
  pool.setOnScreen({filled.keys[0]});
  pool.setBudget(2 * valueBytes());
  QCOMPARE(pool.counted(), 2 * valueBytes());
  QVERIFY2(pool.peek(filled.keys[0]), "on screen");
  QVERIFY2(pool.peek(filled.keys[3]), "needed last");
}

void TestSharedVoxels::whatIsInUseStays() {
  SeriesPool pool(std::size_t(1) << 30);
  const Filled filled(pool, 2);
  const VoxelsPtr drawn = pool.voxelsOf(pool.peek(filled.keys[0])->volume);
  pool.setBudget(1);
  QCOMPARE(pool.voxelsOf(drawn->volume()), drawn);
  QCOMPARE(drawn->bytes(), filled.computedBytes);
  // A volume that others hold counts though it was let go of.
  pool.clear();
  QCOMPARE(pool.counted(), valueBytes() + filled.computedBytes);
}

void TestSharedVoxels::roomIsMadeBeforeItIsTaken_data() {
  QTest::addColumn<int>("budget");
  QTest::addColumn<int>("available");
  QTest::addColumn<int>("wanted");
  QTest::addColumn<bool>("isRoom");
  QTest::addColumn<int>("held");
  // In volumes of a series; nothing was computed of them.
  QTest::newRow("there is room") << 8 << 8 << 4 << true << 4;
  QTest::newRow("the budget is short") << 6 << 8 << 4 << true << 2;
  QTest::newRow("the machine is short") << 8 << 1 << 3 << true << 2;
  QTest::newRow("the last needed stays") << 4 << 8 << 4 << true << 1;
  QTest::newRow("the machine has not enough") << 8 << 1 << 5 << false << 1;
}

void TestSharedVoxels::roomIsMadeBeforeItIsTaken() {
  QFETCH(int, budget);
  QFETCH(int, available);
  QFETCH(int, wanted);
  QFETCH(int, held);
  SeriesPool pool(std::size_t(budget) * valueBytes(), [=] { return std::size_t(available) * valueBytes(); });
  std::vector<PoolKey> keys;
  for (int n = 0; n < 4; ++n) {
    const LoadedSeriesPtr series = ballSeries();
    keys.push_back({keyOf(series->series), {}});
    pool.put(keys.back(), series);
  }
  QTEST(pool.makeRoomFor(std::size_t(wanted) * valueBytes()), "isRoom");
  QCOMPARE(pool.bytes(), std::size_t(held) * valueBytes());
}

void TestSharedVoxels::shortMemoryIsASentence() {
  const VolumePtr head = *makePhantom("ct-head:48");
  SeriesPool pool(std::size_t(1) << 30, [] { return 1000; });
  const auto drawn = drawWithCaches(pool.voxelsOf(head))(*presetScene("auto", *head), ofSize(64, 64), {});
  QVERIFY(!drawn.ok());
  QVERIFY2(drawn.message().find("not enough memory") != std::string::npos, drawn.message().c_str());
}

VOLUMEN_TEST(TestSharedVoxels);
#include "tst_shared_voxels.moc"
