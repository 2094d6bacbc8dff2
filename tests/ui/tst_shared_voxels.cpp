// Guards design.md 11: what is computed once for a volume is shared by all views that draw it, and released
// with it.
#include "tests/ui/slow_renderer.h"
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

VOLUMEN_TEST(TestSharedVoxels);
#include "tst_shared_voxels.moc"
