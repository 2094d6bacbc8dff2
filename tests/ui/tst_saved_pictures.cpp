// Guards design.md 8: all requests for saved pictures are answered, each drawn from its own volume.
#include "tests/ui/slow_renderer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSavedPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesToSaveAreDrawnAndCancelled();
  void picturesAreOfTheVolumeTheyWereAskedOf();
};

void TestSavedPictures::picturesToSaveAreDrawnAndCancelled() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  QSignalSpy ready(&w.service, &DrawService::pictureReady);
  const VolumePtr volume = smallVolume();
  const int number = w.service.requestPicture(volume, greyScene(0.5), ofSize(30, 20));
  QTRY_COMPARE(ready.count(), 1);
  QCOMPARE(ready[0][0].toInt(), number);
  const auto drawn = ready[0][1].value<std::shared_ptr<Drawn>>();
  QVERIFY(drawn && drawn->picture.size == glm::ivec2(30, 20));
  renderer.msPerRow = 5;
  w.service.requestPicture(volume, greyScene(0.5), ofSize(30, 2000));
  w.service.requestPicture(volume, greyScene(0.5), ofSize(30, 2000));
  QTRY_VERIFY(renderer.begun == 2);
  w.service.cancelPictures();
  QTRY_COMPARE(ready.count(), 3);
  for (int n : {1, 2}) {
    QVERIFY(!ready[n][1].value<std::shared_ptr<Drawn>>());
    QCOMPARE(ready[n][2].toString(), QStringLiteral("Cancelled."));
  }
}

namespace {

// Draws every volume in the grey of its values.
MakeDraw greyOfVolume() {
  return [](const VoxelsPtr& voxels) -> Draw {
    return {[](const Scene& scene, const RenderOptions& options, const CancelToken&) -> Result<Planned> {
              Planned planned;
              planned.plan.scene = scene;
              planned.plan.options = options;
              return planned;
            },
            [volume = voxels->volume()](const Planned& planned, const CancelToken&) -> Result<Drawn> {
              QThread::msleep(30);
              Drawn drawn;
              drawn.picture.size = planned.plan.options.size;
              drawn.picture.rgba.assign(std::size_t(4) * drawn.picture.size.x * drawn.picture.size.y,
                                        float(volume->valueAt(0)));
              return drawn;
            }};
  };
}

}  // namespace

void TestSavedPictures::picturesAreOfTheVolumeTheyWereAskedOf() {
  Watched w(greyOfVolume());
  const VolumePtr first = smallVolume(), second = smallVolume(0);
  QSignalSpy ready(&w.service, &DrawService::pictureReady);
  w.service.show(0, first);
  std::vector<int> numbers;
  for (int n = 0; n < 3; ++n)
    numbers.push_back(w.service.requestPicture(first, greyScene(0.5), ofSize(8, 8)));
  w.service.show(0, second);
  w.service.request(0, greyScene(0.5), {8, 8});
  numbers.push_back(w.service.requestPicture(second, greyScene(0.5), ofSize(8, 8)));
  w.service.show(0, nullptr);
  QTRY_COMPARE(ready.count(), 4);
  for (int n = 0; n < 4; ++n) {
    QCOMPARE(ready[n][0].toInt(), numbers[std::size_t(n)]);
    const auto drawn = ready[n][1].value<std::shared_ptr<Drawn>>();
    QVERIFY(drawn);
    QCOMPARE(drawn->picture.rgba[0], n < 3 ? 1.0f : 0.0f);
  }
}

VOLUMEN_TEST(TestSavedPictures);
#include "tst_saved_pictures.moc"
