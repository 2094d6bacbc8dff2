// Guards DESIGN 8 (the UI thread never renders or waits; the latest request wins).
#include "tests/ui/slow_renderer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestRenderController : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void draftComesFirstThenStandard();
  void theLatestRequestWins();
  void aNewRequestCancelsTheStandardPicture();
  void thePictureAtRestIsPlannedWhileItWaits();
  void draftsFollowWhileRequestsStream();
  void theLevelAtRestIsDrawn_data();
  void theLevelAtRestIsDrawn();
  void anotherLevelOfTheSamePictureNeedsNoDraft();
  void aLongPictureComesInThreeSteps();
  void theStepInBetweenIsCancelled();
  void whatIsSeenInFullGetsNoCoarser();
  void aTrialWaitsForWhatIsAskedFor();
  void aTrialThatIsDroppedTellsNothing();
  void closingWhileRenderingCancels();
  void anotherVolumeSilencesTheOneBefore();
  void failuresAreTold();
  void aSceneWithoutCameraIsFitted();
};

void TestRenderController::draftComesFirstThenStandard() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.5), {101, 67});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.size(), std::size_t(2));
  QVERIFY(w.frames[0].draft());
  for (const ScreenPicture& frame : w.frames) {
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

void TestRenderController::thePictureAtRestIsPlannedWhileItWaits() {
  SlowRenderer renderer;
  renderer.plansForEver = true;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.2), {64, 64});
  QTRY_COMPARE(renderer.plansBegun.load(), 2);
  QCOMPARE(renderer.begun.load(), 1);
  w.controller.request(greyScene(0.8), {64, 64});
  QTRY_COMPARE(renderer.plansCancelled.load(), 1);
  // The draft of the new one is there; its picture at rest is being planned, the one before was never begun.
  QTRY_COMPARE(renderer.plansBegun.load(), 4);
  QCOMPARE(renderer.begun.load(), 2);
  renderer.plansForEver = false;
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.frames.back().scene.lights[0].intensity, 0.8);
  QCOMPARE(renderer.plansBegun.load(), 4);
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

// 5 us a pixel: 1.5 s in full.
void TestRenderController::aLongPictureComesInThreeSteps() {
  SlowRenderer renderer;
  renderer.microsecondsPerPixel = 5;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.5), {640, 480});
  QTRY_VERIFY_WITH_TIMEOUT(w.atRest(), 60000);
  QCOMPARE(w.frames.size(), std::size_t(3));
  QVERIFY(w.frames[0].draft() && w.frames[1].draft());
  QVERIFY(w.frames[0].factor > w.frames[1].factor && w.frames[1].factor > 1);
  for (const ScreenPicture& frame : w.frames) {
    QCOMPARE(frame.image.size(), QSize(640, 480));
    QVERIFY2(frame.scene == w.frames[0].scene, "the same camera, so that nothing jumps");
    for (const QPoint at : {QPoint(0, 0), QPoint(320, 240), QPoint(639, 479)})
      QCOMPARE(qRed(frame.image.pixel(at)), 128);
  }
}

void TestRenderController::theStepInBetweenIsCancelled() {
  SlowRenderer renderer;
  renderer.microsecondsPerPixel = 10;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.2), {640, 480});
  QTRY_COMPARE_WITH_TIMEOUT(renderer.begun.load(), 2, 60000);
  renderer.microsecondsPerPixel = 0;
  w.controller.request(greyScene(0.8), {64, 48});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(renderer.cancelled.load(), 1);
  for (std::size_t n = 1; n < w.frames.size(); ++n) QCOMPARE(w.frames[n].scene.lights[0].intensity, 0.8);
  QVERIFY(w.failures.isEmpty());
}

void TestRenderController::whatIsSeenInFullGetsNoCoarser() {
  SlowRenderer renderer;
  renderer.microsecondsPerPixel = 5;
  Watched w(renderer.make());
  w.controller.request(greyScene(0.5), {640, 480});
  QTRY_VERIFY_WITH_TIMEOUT(w.atRest(), 60000);
  w.frames.clear();
  w.controller.setLevel({Quality::exact, 1});
  w.controller.request(greyScene(0.5), {640, 480});
  QTRY_VERIFY_WITH_TIMEOUT(w.atRest(), 60000);
  QCOMPARE(w.frames.size(), std::size_t(1));
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
  QVERIFY(trial.ms > 0);
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

void TestRenderController::closingWhileRenderingCancels() {
  SlowRenderer renderer;
  renderer.msPerRow = 5;
  {
    Watched w(renderer.make());
    w.controller.request(greyScene(0.5), {64, 8000});  // the draft alone takes 10 s
    QTRY_VERIFY(renderer.begun == 1);
  }
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
  for (const ScreenPicture& frame : w.frames) QCOMPARE(frame.scene.lights[0].intensity, 0.8);
}

void TestRenderController::failuresAreTold() {
  Watched w([](VolumePtr) -> Draw {
    return {[](const auto&...) { return Planned{}; },
            [](const auto&...) -> Result<Drawn> { return Error{"Not enough memory for the gradients."}; }};
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

VOLUMEN_TEST(TestRenderController);
#include "tst_render_controller.moc"
