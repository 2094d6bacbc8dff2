// Guards DESIGN 8 (the UI thread never renders or waits; the latest request wins) and DESIGN 2 (draft: same
// colours, no jump).
#include <QElapsedTimer>
#include <QSignalSpy>
#include <atomic>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "tests/unit/suite.h"
#include "ui/controller/render_controller.h"
#include "viewer/scene/presets.h"
#include "viewer/volume/phantoms.h"

using namespace volumen;

namespace {

VolumePtr smallVolume() {
  VolumeParts parts;
  parts.geometry.size = {4, 4, 4};
  parts.values = std::vector<std::int16_t>(64, 1);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

// Draws a plain picture whose grey is the camera's height / 1000, as slowly as told, row by row.
struct SlowRenderer {
  std::atomic<int> msPerRow{0};
  std::atomic<int> begun{0}, cancelled{0};

  MakeDraw make() {
    return [this](VolumePtr) -> Draw {
      return [this](const Scene& scene, const RenderOptions& options,
                    const CancelToken& cancel) -> Result<Drawn> {
        ++begun;
        Drawn drawn;
        drawn.picture.size = options.size;
        drawn.picture.rgba.assign(std::size_t(4) * options.size.x * options.size.y, 1.0f);
        for (int y = 0; y < options.size.y; ++y) {
          if (cancel.cancelled()) {
            ++cancelled;
            return Error{"cancelled"};
          }
          if (msPerRow > 0) QThread::msleep(unsigned(msPerRow));
          for (int x = 0; x < options.size.x; ++x)
            for (int c = 0; c < 3; ++c) drawn.picture.row(y)[4 * x + c] = float(scene.lights[0].intensity);
        }
        return drawn;
      };
    };
  }
};

Scene greyScene(double grey) {
  Scene scene;
  scene.camera = Camera{};
  scene.lights[0].intensity = grey;
  return scene;
}

RenderOptions ofSize(int width, int height) {
  RenderOptions options;
  options.size = {width, height};
  return options;
}

struct Watched {
  RenderController controller;
  std::vector<Frame> frames;
  QStringList failures;

  explicit Watched(MakeDraw make) : controller(std::move(make)) {
    QObject::connect(&controller, &RenderController::frameReady, &controller,
                     [this](const Frame& frame) { frames.push_back(frame); });
    QObject::connect(&controller, &RenderController::failed, &controller,
                     [this](const QString& sentence) { failures << sentence; });
    controller.setVolume(smallVolume());
  }
  bool atRest() const { return !frames.empty() && !frames.back().draft(); }
};

}  // namespace

class TestRenderController : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void draftComesFirstThenStandard();
  void theLatestRequestWins();
  void aNewRequestCancelsTheStandardPicture();
  void draftsFollowWhileRequestsStream();
  void theLevelAtRestIsDrawn_data();
  void theLevelAtRestIsDrawn();
  void anotherLevelOfTheSamePictureNeedsNoDraft();
  void aTrialWaitsForWhatIsAskedFor();
  void aTrialThatIsDroppedTellsNothing();
  void closingWhileRenderingIsCleanAndQuick();
  void anotherVolumeSilencesTheOneBefore();
  void failuresAreTold();
  void aSceneWithoutCameraIsFitted();
  void picturesToSaveAreDrawnAndCancelled();
  void paceKeepsTheFrameTime_data();
  void paceKeepsTheFrameTime();
  void draftSeesWhatTheFullPictureSees_data();
  void draftSeesWhatTheFullPictureSees();
  void enlargingKeepsColours();
  void draftLooksLikeStandard_data();
  void draftLooksLikeStandard();
};

void TestRenderController::draftComesFirstThenStandard() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.5), {101, 67});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.size(), std::size_t(2));
  QVERIFY(w.frames[0].draft());
  for (const Frame& frame : w.frames) {
    QCOMPARE(frame.image.size(), QSize(101, 67));
    QCOMPARE(qRed(frame.image.pixel(50, 33)), 128);
  }
}

void TestRenderController::theLatestRequestWins() {
  SlowRenderer renderer;
  renderer.msPerRow = 1;
  Watched w(renderer.make());
  for (int n = 1; n <= 200; ++n) w.controller.request(greyScene(n / 200.0), {40, 40});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.back().scene.lights[0].intensity, 1.0);
  QVERIFY2(renderer.begun < 10, "requests that nobody waits for any more are not drawn");
}

void TestRenderController::aNewRequestCancelsTheStandardPicture() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.2), {64, 400});  // the standard picture takes 800 ms
  QTRY_VERIFY(!w.frames.empty());
  QTRY_VERIFY(renderer.begun == 2);
  w.controller.request(greyScene(0.8), {64, 20});
  QTRY_COMPARE(renderer.cancelled.load(), 1);
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.back().scene.lights[0].intensity, 0.8);
  QVERIFY(w.failures.isEmpty());
}

void TestRenderController::draftsFollowWhileRequestsStream() {
  SlowRenderer renderer;
  renderer.msPerRow = 1;
  Watched w(renderer.make());
  for (int n = 0; n < 40; ++n) {
    w.controller.request(greyScene(n / 40.0), {64, 80});
    QTest::qWait(10);
  }
  QVERIFY2(w.frames.size() >= 5, "a drag is followed, although each request outdates the one before");
}

void TestRenderController::theLevelAtRestIsDrawn_data() {
  QTest::addColumn<int>("quality");
  QTest::addColumn<int>("edge");
  QTest::addColumn<int>("frames");
  QTest::newRow("standard") << int(Quality::standard) << 1 << 2;
  QTest::newRow("exact") << int(Quality::exact) << 1 << 2;
  QTest::newRow("draft, every pixel") << int(Quality::draft) << 1 << 2;
  QTest::newRow("no finer than the first draft: drawn once") << int(Quality::draft) << 4 << 1;
}

void TestRenderController::theLevelAtRestIsDrawn() {
  QFETCH(int, quality);
  QFETCH(int, edge);
  QFETCH(int, frames);
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.controller.setLevel({Quality(quality), edge});
  w.controller.request(greyScene(0.5), {64, 64});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(int(w.frames.size()), frames);
  QCOMPARE(int(w.frames.back().quality), quality);
  QCOMPARE(w.frames.back().factor, double(edge));
  QCOMPARE(w.frames.back().image.size(), QSize(64, 64));
}

void TestRenderController::anotherLevelOfTheSamePictureNeedsNoDraft() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.5), {64, 64});
  QTRY_VERIFY(w.atRest());
  w.frames.clear();
  w.controller.setLevel({Quality::exact, 1});
  w.controller.request(greyScene(0.5), {64, 64});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.size(), std::size_t(1));
  w.frames.clear();
  w.controller.request(greyScene(0.6), {64, 64});
  QTRY_VERIFY(w.atRest());
  QVERIFY2(w.frames.front().draft(), "another picture comes as a draft first");
}

void TestRenderController::aTrialWaitsForWhatIsAskedFor() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  QSignalSpy trials(&w.controller, &RenderController::trialReady);
  const int number = w.controller.requestTrial(greyScene(0.2), {64, 200}, {Quality::high, 1});
  QTRY_COMPARE(renderer.begun.load(), 1);
  w.controller.request(greyScene(0.8), {64, 20});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(renderer.cancelled.load(), 1);
  QVERIFY2(trials.isEmpty(), "what is looked at comes first");
  // It was not forgotten.
  QTRY_COMPARE(trials.count(), 1);
  const auto trial = trials[0][0].value<Trial>();
  QCOMPARE(trial.number, number);
  QVERIFY(trial.drawn && trial.drawn->picture.size == glm::ivec2(64, 200));
  QVERIFY(trial.ms >= 200 * 2);
}

void TestRenderController::aTrialThatIsDroppedTellsNothing() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  QSignalSpy trials(&w.controller, &RenderController::trialReady);
  w.controller.requestTrial(greyScene(0.2), {64, 2000}, {Quality::high, 1});
  QTRY_COMPARE(renderer.begun.load(), 1);
  w.controller.dropTrial();
  QTRY_COMPARE(renderer.cancelled.load(), 1);
  w.controller.request(greyScene(0.8), {64, 20});
  QTRY_VERIFY(w.atRest());
  QVERIFY(trials.isEmpty());
}

void TestRenderController::closingWhileRenderingIsCleanAndQuick() {
  SlowRenderer renderer;
  renderer.msPerRow = 5;
  QElapsedTimer clock;
  {
    Watched w(renderer.make());
    w.controller.request(greyScene(0.5), {64, 8000});  // the draft alone takes 10 s
    QTRY_VERIFY(renderer.begun == 1);
    clock.start();
  }
  QVERIFY(clock.elapsed() < 1000);
  QCOMPARE(renderer.cancelled.load(), 1);
}

void TestRenderController::anotherVolumeSilencesTheOneBefore() {
  SlowRenderer renderer;
  renderer.msPerRow = 3;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.2), {64, 400});
  QTRY_VERIFY(renderer.begun == 1);
  w.controller.setVolume(smallVolume());
  renderer.msPerRow = 0;
  w.controller.request(greyScene(0.8), {64, 40});
  QTRY_VERIFY(w.atRest());
  for (const Frame& frame : w.frames) QCOMPARE(frame.scene.lights[0].intensity, 0.8);
}

void TestRenderController::failuresAreTold() {
  Watched w([](VolumePtr) -> Draw {
    return [](const Scene&, const RenderOptions&, const CancelToken&) -> Result<Drawn> {
      return Error{"Not enough memory for the gradients."};
    };
  });
  w.controller.request(greyScene(0.5), {64, 64});
  QTRY_COMPARE(w.failures, QStringList{QStringLiteral("Not enough memory for the gradients.")});
  QVERIFY(w.frames.empty());
}

void TestRenderController::aSceneWithoutCameraIsFitted() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  Scene scene;
  scene.lights[0].intensity = 0.5;
  w.controller.request(scene, {200, 100});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.back().scene.camera->height, 4.0);  // four voxels of 1 mm
  w.controller.request(scene, {100, 200});
  QTRY_COMPARE(w.frames.back().scene.camera->height, 8.0);
}

void TestRenderController::picturesToSaveAreDrawnAndCancelled() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  QSignalSpy ready(&w.controller, &RenderController::pictureReady);
  w.controller.requestPicture(greyScene(0.5), ofSize(30, 20));
  QTRY_COMPARE(ready.count(), 1);
  const auto drawn = ready[0][0].value<std::shared_ptr<Drawn>>();
  QVERIFY(drawn && drawn->picture.size == glm::ivec2(30, 20));
  renderer.msPerRow = 5;
  w.controller.requestPicture(greyScene(0.5), ofSize(30, 2000));
  QTRY_VERIFY(renderer.begun == 2);
  w.controller.cancelPicture();
  QTRY_COMPARE(ready.count(), 2);
  QVERIFY(!ready[1][0].value<std::shared_ptr<Drawn>>());
  QCOMPARE(ready[1][1].toString(), QStringLiteral("Cancelled."));
}

void TestRenderController::paceKeepsTheFrameTime_data() {
  QTest::addColumn<double>("fullMs");
  QTest::addColumn<double>("factor");
  QTest::newRow("fast machine, full size") << 10.0 << 1.0;
  QTest::newRow("100 ms a picture") << 100.0 << 2.0;
  QTest::newRow("1000 ms a picture") << 1000.0 << 5.0;
  QTest::newRow("slower than any draft") << 100000.0 << 7.0;
}

void TestRenderController::paceKeepsTheFrameTime() {
  QFETCH(double, fullMs);
  QFETCH(double, factor);
  DraftPace pace(40);
  for (int n = 0; n < 20; ++n) pace.measured(fullMs / (pace.factor() * pace.factor()));
  QCOMPARE(pace.factor(), factor);
  pace.measured(fullMs / (pace.factor() * pace.factor()));
  QCOMPARE(pace.factor(), factor);  // and stays
}

void TestRenderController::draftSeesWhatTheFullPictureSees_data() {
  QTest::addColumn<QSize>("full");
  QTest::addColumn<double>("factor");
  QTest::newRow("divides") << QSize(512, 512) << 4.0;
  QTest::newRow("odd size") << QSize(1013, 677) << 8.0;
  QTest::newRow("fraction") << QSize(511, 333) << 1.5;
}

void TestRenderController::draftSeesWhatTheFullPictureSees() {
  QFETCH(QSize, full);
  QFETCH(double, factor);
  Camera camera;
  const DraftView view = draftView(camera, full, factor);
  // Millimetres a draft pixel covers = factor times those of a full pixel, in both directions (pixels are
  // square).
  const double fullMm = camera.height / full.height(), draftMm = view.camera.height / view.size.height();
  QVERIFY(std::abs(draftMm / fullMm - factor) < 1e-9);
  QVERIFY(view.size.width() * factor >= full.width() && view.size.height() * factor >= full.height());
  const auto tangent = [](double fov) { return std::tan(glm::radians(fov) / 2); };
  QVERIFY(std::abs(tangent(view.camera.fov) / view.size.height() -
                   factor * tangent(camera.fov) / full.height()) < 1e-12);
}

void TestRenderController::enlargingKeepsColours() {
  // A horizontal ramp, linear: bilinear enlargement gives the ramp at the finer pixels.
  Picture picture{.size = {20, 10}, .transparent = false, .rgba = std::vector<float>(800, 1.0f)};
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c) picture.row(y)[4 * x + c] = float((x + 0.5) / 20);
  const QImage image = enlarged(picture, 4, {78, 39});
  QCOMPARE(image.size(), QSize(78, 39));
  for (int x = 4; x < 74; ++x) {
    const double expected = ((x + 0.5 - 39) / 4 + 10) / 20;
    QVERIFY(std::abs(qRed(image.pixel(x, 20)) - 255 * expected) <= 0.51);  // the rounding to bytes
  }
}

void TestRenderController::draftLooksLikeStandard_data() {
  QTest::addColumn<double>("factor");
  for (double factor : {1.5, 3.0, 5.0, 7.0})
    QTest::addRow("one ray for %g x %g pixels", factor, factor) << factor;
}

void TestRenderController::draftLooksLikeStandard() {
  QFETCH(double, factor);
  static const VolumePtr head = *makePhantom("ct-head:96");
  static const Draw draw = drawWithCaches(head);
  static Scene scene = *presetScene("auto", *head);
  const QSize full(400, 336);
  scene.camera = fitCamera(Camera{}, head->geometry(), double(full.width()) / full.height());
  RenderOptions options = ofSize(full.width(), full.height());
  static const Result<Drawn> standard = draw(scene, options, {});
  QVERIFY(standard.ok());
  const DraftView view = draftView(*scene.camera, full, factor);
  Scene draftScene = scene;
  draftScene.camera = view.camera;
  options.size = {view.size.width(), view.size.height()};
  options.quality = Quality::draft;
  const Result<Drawn> drawn = draw(draftScene, options, {});
  QVERIFY(drawn.ok());
  const QImage draft = enlarged(drawn->picture, factor, full), rest = toImage(standard->picture);
  // DESIGN 2: means over blocks of 16 x 16 within 3/255 RMSE, mean colour within 1/255.
  constexpr int edge = 16;
  double squares = 0, sum[3] = {};
  int blocks = 0;
  for (int by = 0; by + edge <= full.height(); by += edge)
    for (int bx = 0; bx + edge <= full.width(); bx += edge, ++blocks) {
      double difference[3] = {};
      for (int y = by; y < by + edge; ++y)
        for (int x = bx; x < bx + edge; ++x) {
          const QRgb a = draft.pixel(x, y), b = rest.pixel(x, y);
          difference[0] += qRed(a) - qRed(b);
          difference[1] += qGreen(a) - qGreen(b);
          difference[2] += qBlue(a) - qBlue(b);
        }
      for (int c = 0; c < 3; ++c) {
        const double mean = difference[c] / (edge * edge);
        squares += mean * mean;
        sum[c] += mean;
      }
    }
  const double rmse = std::sqrt(squares / (3 * blocks));
  QVERIFY2(rmse <= 3, qPrintable(QString::number(rmse)));
  for (double total : sum)
    QVERIFY2(std::abs(total / blocks) <= 1, qPrintable(QString::number(total / blocks)));
}

VOLUMEN_TEST(TestRenderController);
#include "tst_render_controller.moc"
