// Guards design.md 3 (the GL resampler: what is kept between pictures, behaviour without OpenGL) and
// design.md 2 (determinism).
#include <chrono>
#include <thread>

#include "tests/fixtures/need_gl.h"
#include "tests/unit/render/method_cases.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Result<Rendered> drawGl(RenderCaches& caches, const Scene& scene, RenderOptions options,
                        const CancelToken& cancel = {}) {
  options.resampler = Resampler::gl;
  return planAndDraw(caches, scene, options, cancel);
}

}  // namespace

class TestGlState : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void secondPictureIsTheSame();
  void picturesMayAlternate();
  void methodsMayAlternate();
  void fullIsTheSame();
  void levelsChooseWhereItIsFiltered_data();
  void levelsChooseWhereItIsFiltered();
  void noOpenGlIsASentence();
  void contextThatCannotBeCurrentIsASentence();
  void cancelledIsSaid();
  void aCancelledBlendLeavesNothing();
  void referenceHasItsOwn();
};

void TestGlState::secondPictureIsTheSame() {
  NEED_GL();
  RenderCaches caches(wavyVolume());
  RenderOptions options;
  options.size = {40, 30};
  const auto first = drawGl(caches, softScene(), options);
  options.threads = 1;
  const auto second = drawGl(caches, softScene(), options);
  RenderCaches others(wavyVolume());
  const auto third = drawGl(others, softScene(), options);
  QVERIFY(first.ok() && second.ok() && third.ok());
  QVERIFY(first->picture == second->picture);
  QVERIFY(first->picture == third->picture);
  QCOMPARE(second->stats.threads, 1);
  QVERIFY(first->stats.densityBytes > 0 && first->stats.gradientBytes > 0);
}

// Textures, programs and targets are kept between pictures. None may be used for the wrong picture.
void TestGlState::picturesMayAlternate() {
  NEED_GL();
  RenderCaches caches(wavyVolume());
  Scene unlit = softScene();
  unlit.shading.lit = false;
  RenderOptions small, fine;
  small.size = {20, 20};
  fine.size = {30, 10};
  fine.precision = 32;
  fine.step = 1.0 / 512;
  const auto a = drawGl(caches, softScene(), small);
  QVERIFY(drawGl(caches, unlit, fine).ok());
  QVERIFY(drawGl(caches, softScene(), fine).ok());
  QVERIFY(drawGl(caches, unlit, small).ok());
  const auto b = drawGl(caches, softScene(), small);
  QVERIFY(a.ok() && b.ok());
  QVERIFY(a->picture == b->picture);
}

void TestGlState::methodsMayAlternate() {
  NEED_GL();
  RenderCaches caches(wavyVolume());
  std::vector<Picture> pictures;
  for (int round = 0; round < 2; ++round)
    for (Method method : {Method::planes, Method::blend, Method::gpu, Method::preshaded}) {
      RenderOptions options;
      options.size = {24, 20};
      options.step = 0.5;
      options.method = method;
      const auto done = drawGl(caches, softScene(), options);
      QVERIFY2(done.ok(), done.ok() ? "" : done.message().c_str());
      pictures.push_back(done->picture);
    }
  for (int n = 0; n < 4; ++n) QVERIFY(pictures[n] == pictures[n + 4]);
}

// The kernels skip empty blocks, in planes too.
void TestGlState::fullIsTheSame() {
  NEED_GL();
  RenderOptions options;
  options.size = {64, 64};
  Scene scene = softScene();
  scene.camera->height = 300;
  RenderCaches caches(*makePhantom("ct-head:64"));
  const auto lean = drawGl(caches, scene, options);
  options.full = true;
  const auto full = drawGl(caches, scene, options);
  QVERIFY(lean.ok() && full.ok());
  QVERIFY(lean->picture == full->picture);
}

// Filters of 8 bits cost 0.7/255 RMSE at standard's steps as measured. Standard can afford that, high and
// exact cannot.
void TestGlState::levelsChooseWhereItIsFiltered_data() {
  QTest::addColumn<int>("quality");
  QTest::addColumn<bool>("steps");
  QTest::addColumn<int>("bits");
  QTest::newRow("draft: by the hardware") << int(Quality::draft) << false << 16;
  QTest::newRow("standard: by the hardware") << int(Quality::standard) << false << 16;
  QTest::newRow("high: in the shader") << int(Quality::high) << false << 32;
  QTest::newRow("exact: in the shader") << int(Quality::exact) << false << 32;
  QTest::newRow("plain steps: in the shader") << int(Quality::standard) << true << 32;
}

void TestGlState::levelsChooseWhereItIsFiltered() {
  QFETCH(int, quality);
  QFETCH(bool, steps);
  QFETCH(int, bits);
  RenderOptions options;
  options.resampler = Resampler::gl;
  options.quality = Quality(quality);
  if (steps) options.step = 1;
  RenderCaches caches(wavyVolume());
  const auto plan = makePlan(softScene(), caches.facts(), options);
  QVERIFY(plan.ok());
  QVERIFY(plan->resampler == Resampler::gl);
  QCOMPARE(plan->bits, bits);
  options.precision = 48 - bits;
  const auto asked = makePlan(softScene(), caches.facts(), options);
  QVERIFY(asked.ok());
  QCOMPARE(asked->bits, 48 - bits);
}

void TestGlState::noOpenGlIsASentence() {
  RenderCaches caches(wavyVolume());
  caches.setGlContextFactory([]() -> Result<std::unique_ptr<GlContext>> { return Error{"none is here"}; });
  RenderOptions options;
  options.size = {8, 8};
  const auto done = drawGl(caches, softScene(), options);
  QVERIFY(!done.ok());
  QCOMPARE(done.message(), std::string("No OpenGL could be had: none is here; use --resampler cpu."));
  QVERIFY(planAndDraw(caches, softScene(), options).ok());
}

void TestGlState::contextThatCannotBeCurrentIsASentence() {
  class Dead : public GlContext {
    bool makeCurrent() override { return false; }
    void doneCurrent() override { qFatal("it never was current"); }
  };
  RenderCaches caches(wavyVolume());
  caches.setGlContextFactory([]() -> Result<std::unique_ptr<GlContext>> {
    return std::unique_ptr<GlContext>(std::make_unique<Dead>());
  });
  const auto done = drawGl(caches, softScene(), {});
  QVERIFY(!done.ok());
  QVERIFY2(done.message().find("use --resampler cpu") != std::string::npos, done.message().c_str());
}

void TestGlState::cancelledIsSaid() {
  NEED_GL();
  RenderCaches caches(wavyVolume());
  CancelToken cancel;
  cancel.cancel();
  RenderOptions options;
  options.size = {8, 8};
  const auto done = drawGl(caches, softScene(), options, cancel);
  QVERIFY(!done.ok());
  QCOMPARE(done.message(), std::string("cancelled"));
  QVERIFY(drawGl(caches, softScene(), options).ok());
}

// The frame buffer's blending must not affect the next picture.
void TestGlState::aCancelledBlendLeavesNothing() {
  NEED_GL();
  RenderCaches caches(wavyVolume());
  RenderOptions planes, blend;
  planes.size = blend.size = {64, 64};
  const auto before = drawGl(caches, softScene(), planes);
  blend.method = Method::blend;
  blend.step = 1.0 / 512;  // takes seconds
  CancelToken cancel;
  std::thread impatient([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    cancel.cancel();
  });
  const auto cancelled = drawGl(caches, softScene(), blend, cancel);
  impatient.join();
  QVERIFY(!cancelled.ok());
  QCOMPARE(cancelled.message(), std::string("cancelled"));
  const auto after = drawGl(caches, softScene(), planes);
  QVERIFY(before.ok() && after.ok());
  QVERIFY(after->picture == before->picture);
}

void TestGlState::referenceHasItsOwn() {
  RenderCaches caches(wavyVolume());
  RenderOptions options;
  options.method = Method::reference;
  const auto done = drawGl(caches, softScene(), options);
  QVERIFY(!done.ok());
  QVERIFY2(done.message().find("--resampler gl") != std::string::npos, done.message().c_str());
}

VOLUMEN_TEST(TestGlState);
#include "tst_gl_state.moc"
