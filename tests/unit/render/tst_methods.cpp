// Guards design.md 3 (every method against the reference), picture.md 9 and design.md 2 (determinism).
#include <cmath>
#include <map>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/need_gl.h"
#include "tests/fixtures/picture_words.h"
#include "tests/unit/render/method_cases.h"
#include "tests/unit/render/random_scenes.h"
#include "tests/unit/suite.h"
#include "viewer/reference/reference.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::ivec2 size{36, 30};
constexpr double step = 0.5;

/// References for a scene.
struct Truth {
  Picture reference;
  PictureError rule;  ///< error of the midpoint rule in double precision
};

const Truth& truthOf(int scene) {
  static std::map<int, Truth> all;
  const auto [entry, isNew] = all.try_emplace(scene);
  if (isNew) {
    const Scene& s = methodScenes()[scene].scene;
    const VolumePtr volume = wavyVolume();
    entry->second.reference = *renderReference(completed(s, *volume, size), *volume, size);
    entry->second.rule = compare(bruteForce(s, *volume, size, step), entry->second.reference);
  }
  return entry->second;
}

Result<Rendered> drawAsAsked(const Scene& scene, RenderOptions options) {
  static RenderCaches caches(wavyVolume());
  options.size = size;
  return planAndDraw(caches, scene, options);
}

Result<Rendered> draw(const Scene& scene, RenderOptions options) {
  options.step = step;
  return drawAsAsked(scene, options);
}

/// Largest number of samples on a ray, as the volume's diagonal is shorter than 39 voxels.
constexpr int mostSlices = int(39 / step) + 1;

/// Returns the error that a method adds to the midpoint rule (/255). A frame buffer adds at most half a level
/// a slice. OpenGL may also round the slice and its product with the rest, which triples that. For filters of
/// texture hardware see tst_gl.cpp.
double ownErrorOf(const RenderOptions& o, const std::string& kernel) {
  const double rounding = 0.5 * mostSlices * (o.resampler == Resampler::gl ? 3 : 1);
  if (o.blending == Blending::bits8) return rounding;
  if (o.blending == Blending::bits16) return rounding * 255 / 65535;
  if (o.resampler == Resampler::gl && o.precision == 16) return kernel.find("llvmpipe") == 0 ? 0.05 : 1.5;
  return 0;
}

}  // namespace

using Change = void (*)(Scene&, RenderOptions&);
Q_DECLARE_METATYPE(Change)

class TestMethods : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void keepsItsError_data() { addRows(false); }
  void keepsItsError();
  void keepsThePromiseOfItsLevel_data() { addRows(false); }
  void keepsThePromiseOfItsLevel();
  void projectsAsPlanesDo_data();
  void projectsAsPlanesDo();
  void threadsAndFullChangeNoByte_data() { addRows(true); }
  void threadsAndFullChangeNoByte();
  void aFrameBufferOf8BitsHoldsBytes();
  void gpuShadesAsTheCpuDoes_data();
  void gpuShadesAsTheCpuDoes();
  void largePicturesComeInBands();
  void scenesOfChanceAreFiniteAndTheSameEveryWay();

 private:
  static void addRows(bool preshaded);
};

// Preshaded pictures differ from the reference: see tst_preshaded.cpp.
void TestMethods::addRows(bool preshaded) {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("scene");
  for (std::size_t m = 0; m < methodCases().size(); ++m)
    for (std::size_t s = 0; s < methodScenes().size(); ++s) {
      if (methodCases()[m].options.method == Method::preshaded && !preshaded) continue;
      QTest::addRow("%s: %s", methodCases()[m].name.c_str(), methodScenes()[s].name.c_str())
          << int(m) << int(s);
    }
}

#define NEED_METHOD(c)                         \
  QFETCH(int, method);                         \
  const MethodCase& c = methodCases()[method]; \
  if (c.needsGl) NEED_GL()

// design.md 2: errors are at most those of the midpoint rule in double precision plus three terms. Stored
// precision adds 5 % (the same samples, rounded). Ended rays add what lies behind the final transmittance.
// The method adds its own error.
void TestMethods::keepsItsError() {
  NEED_METHOD(c);
  QFETCH(int, scene);
  const auto done = draw(methodScenes()[scene].scene, c.options);
  QVERIFY2(done.ok(), done.ok() ? "" : done.message().c_str());
  const PictureError& rule = truthOf(scene).rule;
  const PictureError e = compare(done->picture, truthOf(scene).reference);
  const double own = ownErrorOf(c.options, done->stats.kernel);
  QVERIFY2(e.rmse <= 1.05 * rule.rmse + 0.01 + own && e.percentile99 <= 1.05 * rule.percentile99 + 0.06 + own,
           qPrintable(inWords(e) + QStringLiteral("; the rule: ") + inWords(rule)));
}

// design.md 2, for every method that does not round deliberately.
void TestMethods::keepsThePromiseOfItsLevel() {
  NEED_METHOD(c);
  QFETCH(int, scene);
  if (c.options.blending) return;
  for (const Quality quality : {Quality::standard, Quality::high}) {
    const LevelPromise& promised = promiseOf(quality);
    RenderOptions options = c.options;
    options.quality = quality;
    const auto done = drawAsAsked(methodScenes()[scene].scene, options);
    QVERIFY2(done.ok(), done.ok() ? "" : done.message().c_str());
    const PictureError e = compare(done->picture, truthOf(scene).reference);
    QVERIFY2(e.psnrDb >= promised.leastPsnrDb && e.percentile99 <= promised.most99, qPrintable(inWords(e)));
  }
}

void TestMethods::projectsAsPlanesDo_data() {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("mode");
  for (std::size_t m = 0; m < methodCases().size(); ++m)
    for (Mode mode : {Mode::mip, Mode::minip, Mode::average}) {
      const char* name = mode == Mode::mip ? "mip" : mode == Mode::minip ? "minip" : "average";
      QTest::addRow("%s: %s", methodCases()[m].name.c_str(), name) << int(m) << int(mode);
    }
}

// Extremes and means use the same samples. Sums in another order may differ by 0.01/255, and the frame buffer
// by half a level. A method refuses an impossible projection in a sentence that names it.
void TestMethods::projectsAsPlanesDo() {
  NEED_METHOD(c);
  QFETCH(int, mode);
  Scene scene = methodScenes().front().scene;
  scene.mode = Mode(mode);
  scene.window = Window{500, 900};
  const auto done = draw(scene, c.options);
  if (!done.ok()) {
    QVERIFY2(done.message().find("--mode") != std::string::npos, done.message().c_str());
    const bool aMeanInBytes = c.options.blending.has_value() && Mode(mode) == Mode::average;
    QVERIFY(aMeanInBytes || c.options.method == Method::preshaded);
    return;
  }
  const PictureError e = compare(done->picture, draw(scene, {})->picture);
  const bool bytes = c.options.blending == Blending::bits8;
  QVERIFY2(e.maximum <= (bytes ? 0.51 : 0.01), qPrintable(inWords(e)));
}

void TestMethods::threadsAndFullChangeNoByte() {
  NEED_METHOD(c);
  QFETCH(int, scene);
  // OpenGL is slow, and perspective changes nothing about threads and rules.
  if (c.needsGl && methodScenes()[scene].scene.camera->projection == Projection::perspective) return;
  RenderOptions options = c.options;
  options.threads = 1;
  const Scene& s = methodScenes()[scene].scene;
  const Picture one = draw(s, options)->picture;
  for (int threads : c.needsGl ? std::vector{7} : std::vector{2, 7, 16}) {
    options.threads = threads;
    QVERIFY2(draw(s, options)->picture == one, qPrintable(QStringLiteral("%1 threads").arg(threads)));
  }
  options.full = true;
  QVERIFY2(draw(s, options)->picture == one, "full");
}

void TestMethods::aFrameBufferOf8BitsHoldsBytes() {
  RenderOptions options;
  options.method = Method::blend;
  options.blending = Blending::bits8;
  const Scene& scene = methodScenes().front().scene;
  const Picture coarse = draw(scene, options)->picture;
  for (float x : coarse.rgba) QCOMPARE(255 * x, std::round(255 * x));
  options.blending = Blending::floats;
  QVERIFY(compare(draw(scene, options)->picture, coarse).rmse > 0.2);
}

void TestMethods::gpuShadesAsTheCpuDoes_data() {
  QTest::addColumn<Change>("change");
  const auto row = [](const char* name, Change change) { QTest::newRow(name) << change; };
  row("directly, two sides", [](Scene&, RenderOptions& o) { o.shader = Shader::phong; });
  row("one side", [](Scene& s, RenderOptions&) { s.shading.sides = 1; });
  row("bilinear map", [](Scene&, RenderOptions& o) { o.mapSize = 16; });
  row("nearest map", [](Scene&, RenderOptions& o) {
    o.mapSize = 16;
    o.mapLookup = MapLookup::nearest;
  });
  row("bilinear map of coloured light", [](Scene& s, RenderOptions& o) {
    o.mapSize = 16;
    s.lights = {{.direction = {1, 0.2, 1}, .colour = {1, 0.4, 0.1}}, {.direction = {-1, 1, 0.5}}};
  });
  row("nearest map of coloured light", [](Scene& s, RenderOptions& o) {
    o.mapSize = 16;
    o.mapLookup = MapLookup::nearest;
    s.lights = {{.direction = {1, 0.2, 1}, .colour = {1, 0.4, 0.1}}, {.direction = {-1, 1, 0.5}}};
  });
  row("table", [](Scene&, RenderOptions& o) { o.shader = Shader::table; });
  row("local viewer", [](Scene& s, RenderOptions&) { s.shading.localViewer = true; });
  row("no specular, lights of all kinds", [](Scene& s, RenderOptions&) {
    s.shading.specular = 0;
    s.lights = {{{1, -2, 0.5}, Space::patient, {0.3, 0.5, 1}, 0.6, true}, {{0, 0, -1}}, {{1, 0, 0}}};
    s.lights.back().on = false;
  });
  row("gradient opacity", [](Scene& s, RenderOptions&) {
    s.transferFunction.gradientOpacity = {{15, 0}, {60, 0.4}, {60, 0.7}, {160, 1}};
  });
  row("curve of many points", [](Scene& s, RenderOptions&) {
    s.transferFunction.points.clear();
    for (int n = 0; n < 40; ++n)
      s.transferFunction.points.push_back(
          {float(-200 + 35 * n), {n % 2 * 1.0, n % 3 / 2.0, 1}, n % 4 / 30.0});
  });
  row("transparent background", [](Scene& s, RenderOptions&) { s.background.transparent = true; });
}

// With floats the operations are the same, except for the driver's exp, log and pow. Samples at the edges of
// patches may fall into the next patch.
void TestMethods::gpuShadesAsTheCpuDoes() {
  NEED_GL();
  QFETCH(Change, change);
  Scene scene = methodScenes().back().scene;
  RenderOptions options;
  change(scene, options);
  options.method = Method::gpu;
  const auto gpu = draw(scene, options);
  QVERIFY2(gpu.ok(), gpu.ok() ? "" : gpu.message().c_str());
  options.method = Method::planes;
  const PictureError e = compare(gpu->picture, draw(scene, options)->picture);
  QVERIFY2(e.rmse <= 0.02 && e.percentile99 <= 0.1, qPrintable(inWords(e)));
}

// The picture has more pixels than are drawn at once.
void TestMethods::largePicturesComeInBands() {
  NEED_GL();
  RenderCaches caches(wavyVolume());
  RenderOptions options;
  options.size = {1100, 500};
  options.step = 8;
  const Scene& scene = methodScenes().front().scene;
  const Picture planes = render(*makePlan(scene, caches.facts(), options), caches)->picture;
  options.resampler = Resampler::gl;
  for (Method method : {Method::gpu, Method::blend}) {
    options.method = method;
    const PictureError e =
        compare(render(*makePlan(scene, caches.facts(), options), caches)->picture, planes);
    QVERIFY2(e.rmse <= 0.02 && e.percentile99 <= 0.1, qPrintable(inWords(e)));
  }
}

void TestMethods::scenesOfChanceAreFiniteAndTheSameEveryWay() {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const RandomScene chance = randomScene(seed);
    RenderCaches caches(chance.volume);
    for (const MethodCase& c : methodCases()) {
      // Creating a context and programs for each volume is slow.
      if (c.needsGl && (!whyNoGl().isEmpty() || seed % 20 != 0)) continue;
      RenderOptions options = c.options;
      options.size = chance.size;
      const auto plan = makePlan(chance.scene, caches.facts(), options);
      if (!plan.ok()) continue;  // impossible combinations: see projectsAsPlanesDo
      const Picture picture = render(*plan, caches)->picture;
      const QString where = QStringLiteral("seed %1, %2").arg(seed).arg(QString::fromStdString(c.name));
      for (float component : picture.rgba) QVERIFY2(component >= 0 && component <= 1, qPrintable(where));
      options.threads = 3;
      options.full = true;
      QVERIFY2(render(*makePlan(chance.scene, caches.facts(), options), caches)->picture == picture,
               qPrintable(where));
    }
  }
}

VOLUMEN_TEST(TestMethods);
#include "tst_methods.moc"
