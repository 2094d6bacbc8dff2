// Guards design.md 8 (the UI thread never renders or waits; the latest request wins).
#include "tests/ui/slow_renderer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDrawService : public QObject {
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
  void theFinerDraftIsCancelled();
  void whatIsSeenInFullGetsNoCoarser();
  void aTrialWaitsForWhatIsAskedFor();
  void aTrialThatIsDroppedTellsNothing();
  void closingWhileRenderingCancels();
  void whatCannotBeDrawnIsCancelled_data();
  void whatCannotBeDrawnIsCancelled();
  void anotherVolumeSilencesTheOneBefore();
  void failuresAreTold();
  void aSceneWithoutCameraIsFitted();
};

void TestDrawService::draftComesFirstThenStandard() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.5), {101, 67});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.withoutFinerDrafts(), 2);
  QVERIFY(w.pictures[0].draft());
  for (const ScreenPicture& picture : w.pictures) {
    QCOMPARE(picture.image.size(), QSize(101, 67));
    QCOMPARE(qRed(picture.image.pixel(50, 33)), 128);
  }
}

void TestDrawService::theLatestRequestWins() {
  SlowRenderer renderer;
  renderer.msPerRow = 1;
  Watched w(renderer.make());
  int last = 0;
  for (int n = 1; n <= 200; ++n) last = w.service.request(0, greyScene(n / 200.0), {40, 40});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.answers.size(), std::size_t(200));
  for (const auto& [number, answers] : w.answers)
    QCOMPARE(answers, std::vector{number == last ? Answer::drawn : Answer::replaced});
  QCOMPARE(w.pictures.back().scene.lights[0].intensity, 1.0);
  QVERIFY2(renderer.begun < 10, "requests that nobody waits for any more are not drawn");
}

void TestDrawService::aNewRequestCancelsTheStandardPicture() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.2), {64, 400});  // the standard picture takes 800 ms
  QTRY_VERIFY(!w.pictures.empty());
  QTRY_VERIFY(renderer.begun == 2);
  w.service.request(0, greyScene(0.8), {64, 20});
  QTRY_COMPARE(renderer.cancelled.load(), 1);
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.pictures.back().scene.lights[0].intensity, 0.8);
  QVERIFY(w.failures.isEmpty());
}

void TestDrawService::thePictureAtRestIsPlannedWhileItWaits() {
  SlowRenderer renderer;
  renderer.plansForEver = true;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.2), {64, 64});
  QTRY_COMPARE(renderer.plansBegun.load(), 2);
  QCOMPARE(renderer.begun.load(), 1);
  w.service.request(0, greyScene(0.8), {64, 64});
  QTRY_COMPARE(renderer.plansCancelled.load(), 1);
  // The draft of the new scene is there. Its picture at rest is being planned, and the previous one was never
  // begun.
  QTRY_COMPARE(renderer.plansBegun.load(), 4);
  QCOMPARE(renderer.begun.load(), 2);
  renderer.plansForEver = false;
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.pictures.back().scene.lights[0].intensity, 0.8);
  QCOMPARE(renderer.plansBegun.load(), 4);
  QVERIFY(w.failures.isEmpty());
}

void TestDrawService::draftsFollowWhileRequestsStream() {
  SlowRenderer renderer;
  renderer.msPerRow = 1;
  Watched w(renderer.make());
  for (int n = 0; n < 40; ++n) {
    w.service.request(0, greyScene(n / 40.0), {64, 80});
    QTest::qWait(10);
  }
  QVERIFY2(w.pictures.size() >= 5, "a drag is followed, although each request outdates the one before");
}

void TestDrawService::theLevelAtRestIsDrawn_data() {
  QTest::addColumn<int>("quality");
  QTest::addColumn<int>("edge");
  QTest::addColumn<int>("pictures");
  QTest::newRow("standard") << int(Quality::standard) << 1 << 2;
  QTest::newRow("exact") << int(Quality::exact) << 1 << 2;
  QTest::newRow("draft, every pixel") << int(Quality::draft) << 1 << 2;
  QTest::newRow("no finer than the first draft: drawn once") << int(Quality::draft) << 4 << 1;
}

void TestDrawService::theLevelAtRestIsDrawn() {
  QFETCH(int, quality);
  QFETCH(int, edge);
  QFETCH(int, pictures);
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.service.setLevel(0, {Quality(quality), edge});
  w.service.request(0, greyScene(0.5), {64, 64});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.withoutFinerDrafts(), pictures);
  QCOMPARE(int(w.pictures.back().quality), quality);
  QCOMPARE(w.pictures.back().factor, double(edge));
  QCOMPARE(w.pictures.back().image.size(), QSize(64, 64));
}

void TestDrawService::anotherLevelOfTheSamePictureNeedsNoDraft() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.5), {64, 64});
  QTRY_VERIFY(w.atRest());
  w.pictures.clear();
  w.service.setLevel(0, {Quality::exact, 1});
  w.service.request(0, greyScene(0.5), {64, 64});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.pictures.size(), std::size_t(1));
  w.pictures.clear();
  w.service.request(0, greyScene(0.6), {64, 64});
  QTRY_VERIFY(w.atRest());
  QVERIFY2(w.pictures.front().draft(), "another picture comes as a draft first");
}

// At 5 us a pixel the full picture takes 1.5 s.
void TestDrawService::aLongPictureComesInThreeSteps() {
  SlowRenderer renderer;
  renderer.microsecondsPerPixel = 5;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.5), {640, 480});
  QTRY_VERIFY_WITH_TIMEOUT(w.atRest(), 60000);
  QCOMPARE(w.pictures.size(), std::size_t(3));
  QVERIFY(w.pictures[0].draft() && w.pictures[1].draft());
  QVERIFY(w.pictures[0].factor > w.pictures[1].factor);
  for (const ScreenPicture& picture : w.pictures) {
    QCOMPARE(picture.image.size(), QSize(640, 480));
    QVERIFY2(picture.scene == w.pictures[0].scene, "the same camera, so that nothing jumps");
    for (const QPoint at : {QPoint(0, 0), QPoint(320, 240), QPoint(639, 479)})
      QCOMPARE(qRed(picture.image.pixel(at)), 128);
  }
}

void TestDrawService::theFinerDraftIsCancelled() {
  SlowRenderer renderer;
  renderer.microsecondsPerPixel = 10;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.2), {640, 480});
  QTRY_COMPARE_WITH_TIMEOUT(renderer.begun.load(), 2, 60000);
  renderer.microsecondsPerPixel = 0;
  w.service.request(0, greyScene(0.8), {64, 48});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(renderer.cancelled.load(), 1);
  for (std::size_t n = 1; n < w.pictures.size(); ++n) QCOMPARE(w.pictures[n].scene.lights[0].intensity, 0.8);
  QVERIFY(w.failures.isEmpty());
}

void TestDrawService::whatIsSeenInFullGetsNoCoarser() {
  SlowRenderer renderer;
  renderer.microsecondsPerPixel = 5;
  Watched w(renderer.make());
  w.service.request(0, greyScene(0.5), {640, 480});
  QTRY_VERIFY_WITH_TIMEOUT(w.atRest(), 60000);
  w.pictures.clear();
  w.service.setLevel(0, {Quality::exact, 1});
  w.service.request(0, greyScene(0.5), {640, 480});
  QTRY_VERIFY_WITH_TIMEOUT(w.atRest(), 60000);
  QCOMPARE(w.pictures.size(), std::size_t(1));
}

void TestDrawService::aTrialWaitsForWhatIsAskedFor() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  QSignalSpy trials(&w.service, &DrawService::trialReady);
  const int number = w.service.requestTrial(w.volume, greyScene(0.2), {64, 200}, {Quality::high, 1});
  QTRY_COMPARE(renderer.begun.load(), 1);
  w.service.request(0, greyScene(0.8), {64, 20});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(renderer.cancelled.load(), 1);
  QVERIFY2(trials.isEmpty(), "what is looked at comes first");
  // The trial is done afterwards.
  QTRY_COMPARE(trials.count(), 1);
  const auto trial = trials[0][0].value<Trial>();
  QCOMPARE(trial.number, number);
  QVERIFY(trial.drawn && trial.drawn->picture.size == glm::ivec2(64, 200));
  QVERIFY(trial.ms > 0);
}

void TestDrawService::aTrialThatIsDroppedTellsNothing() {
  SlowRenderer renderer;
  renderer.msPerRow = 2;
  Watched w(renderer.make());
  QSignalSpy trials(&w.service, &DrawService::trialReady);
  w.service.requestTrial(w.volume, greyScene(0.2), {64, 2000}, {Quality::high, 1});
  QTRY_COMPARE(renderer.begun.load(), 1);
  w.service.dropTrial();
  QTRY_COMPARE(renderer.cancelled.load(), 1);
  w.service.request(0, greyScene(0.8), {64, 20});
  QTRY_VERIFY(w.atRest());
  QVERIFY(trials.isEmpty());
}

void TestDrawService::closingWhileRenderingCancels() {
  SlowRenderer renderer;
  renderer.msPerRow = 5;
  std::vector<std::pair<int, Answer>> answers;
  int number = 0;
  {
    DrawService service(renderer.make());
    connect(&service, &DrawService::answered, &service,
            [&](ViewId, int to, Answer answer) { answers.emplace_back(to, answer); });
    service.show(0, smallVolume());
    number = service.request(0, greyScene(0.5), {64, 8000});  // the draft alone takes 10 s
    QTRY_VERIFY(renderer.begun == 1);
  }
  QCOMPARE(renderer.cancelled.load(), 1);
  const std::vector<std::pair<int, Answer>> once{{number, Answer::cancelled}};
  QCOMPARE(answers, once);
  QTest::qWait(20);
  QCOMPARE(answers, once);
}

void TestDrawService::whatCannotBeDrawnIsCancelled_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<QSize>("pixels");
  QTest::newRow("no pixels") << 0 << QSize(0, 64);
  QTest::newRow("a view that shows nothing") << 1 << QSize(64, 64);
}

void TestDrawService::whatCannotBeDrawnIsCancelled() {
  QFETCH(int, view);
  QFETCH(QSize, pixels);
  SlowRenderer renderer;
  Watched w(renderer.make());
  const int number = w.service.request(view, greyScene(0.5), pixels);
  QVERIFY2(w.answers.empty(), "the number is known before the answer comes");
  QTRY_COMPARE(w.answerTo(number), Answer::cancelled);
  QCOMPARE(renderer.plansBegun.load(), 0);
}

void TestDrawService::anotherVolumeSilencesTheOneBefore() {
  SlowRenderer renderer;
  renderer.msPerRow = 3;
  Watched w(renderer.make());
  const int before = w.service.request(0, greyScene(0.2), {64, 400});
  QTRY_VERIFY(renderer.begun == 1);
  w.service.show(0, smallVolume());
  renderer.msPerRow = 0;
  w.service.request(0, greyScene(0.8), {64, 40});
  QTRY_VERIFY(w.atRest());
  for (const ScreenPicture& picture : w.pictures) QCOMPARE(picture.scene.lights[0].intensity, 0.8);
  QCOMPARE(w.answerTo(before), Answer::cancelled);
}

void TestDrawService::failuresAreTold() {
  Watched w([](const VoxelsPtr&) -> Draw {
    return {[](const auto&...) { return Planned{}; },
            [](const auto&...) -> Result<Drawn> { return Error{"Not enough memory for the gradients."}; }};
  });
  const int number = w.service.request(0, greyScene(0.5), {64, 64});
  QTRY_COMPARE(w.failures, QStringList{QStringLiteral("Not enough memory for the gradients.")});
  QVERIFY(w.pictures.empty());
  QCOMPARE(w.answerTo(number), Answer::failed);
}

void TestDrawService::aSceneWithoutCameraIsFitted() {
  SlowRenderer renderer;
  Watched w(renderer.make());
  Scene scene;
  scene.lights[0].intensity = 0.5;
  w.service.request(0, scene, {200, 100});
  QTRY_VERIFY(w.atRest());
  QCOMPARE(w.pictures.back().scene.camera->height, 4.0);  // four voxels of 1 mm
  w.service.request(0, scene, {100, 200});
  QTRY_COMPARE(w.pictures.back().scene.camera->height, 8.0);
}

VOLUMEN_TEST(TestDrawService);
#include "tst_draw_service.moc"
