// Guards DESIGN 5: the choices of method, resampler and shader, by the cost model where they are left open.
#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestChoiceRules : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aChoiceSaysWhatAndWhy_data();
  void aChoiceSaysWhatAndWhy();
  void fullChoosesAlike_data();
  void fullChoosesAlike();
};

void TestChoiceRules::aChoiceSaysWhatAndWhy_data() {
  addRuleColumns();
  const auto row = addRuleRow;
  row("the CPU resamples", "resampler",
      "on   resampler: cpu: can pass over empty blocks, stops where a ray is opaque, and draws the same on "
      "every machine",
      [](Asked&) {});
  row("the CPU resamples a projection", "resampler", "on   resampler: cpu: draws the same on every machine",
      [](Asked& a) { a.scene.mode = Mode::mip; });
  row("OpenGL resamples", "resampler",
      "on   resampler: gl, as asked: filtered by the texture hardware, while the CPU shades; its steps do "
      "not "
      "see what lies between, so no error is promised",
      [](Asked& a) { a.options.resampler = Resampler::gl; });
  row("one light: direct", "shader",
      "on   shader: direct: light from 1 light at a predicted 0.097 of what a reflectance map takes",
      [](Asked&) {});
  row("three lights: still direct", "shader",
      "on   shader: direct: light from 3 lights at a predicted 0.29 of what a reflectance map takes",
      [](Asked& a) { a.scene.lights.resize(3); });
  row("forty lights: map", "shader",
      "on   shader: reflectance map: light from 40 lights at a predicted 0.27 of what direct light takes",
      [](Asked& a) { a.scene.lights.resize(40); });
  row("thirty lights without highlights: direct", "shader",
      "on   shader: direct: light from 30 lights at a predicted 0.92 of what a reflectance map takes",
      [](Asked& a) {
        a.scene.lights.resize(30);
        a.scene.shading.specular = 0;
      });
  row("eight lights, a whole shininess: direct", "shader",
      "on   shader: direct: light from 8 lights at a predicted 0.77 of what a reflectance map takes",
      [](Asked& a) { a.scene.lights.resize(8); });
  row("eight lights, one of them red: direct", "shader",
      "on   shader: direct: light from 8 lights at a predicted 0.39 of what a reflectance map takes",
      [](Asked& a) {
        a.scene.lights.resize(8);
        a.scene.lights[3].colour = {1, 0, 0};
      });
  row("sixteen lights, any other shininess: map", "shader",
      "on   shader: reflectance map: light from 16 lights at a predicted 0.22 of what direct light takes",
      [](Asked& a) {
        a.scene.lights.resize(16);
        a.scene.shading.shininess = 20.5;
      });
  row("the same in few pixels: a map has more nodes than the picture samples", "shader",
      "on   shader: direct: light from 16 lights at a predicted 0.26 of what a reflectance map takes",
      [](Asked& a) {
        a.scene.lights.resize(16);
        a.scene.shading.shininess = 20.5;
        a.options.size = {32, 32};
      });
  row("lights that are off cost nothing", "shader",
      "on   shader: direct: light from 1 light at a predicted 0.097 of what a reflectance map takes",
      [](Asked& a) {
        a.scene.lights.resize(40);
        for (int n = 1; n < 40; ++n) a.scene.lights[n].on = false;
      });
  row("no light shines", "shader", "on   shader: direct: no light shines",
      [](Asked& a) { a.scene.lights.clear(); });
  row("exact: direct", "shader", "on   shader: direct: the exact light is asked for", [](Asked& a) {
    a.scene.lights.resize(40);
    a.options.quality = Quality::exact;
  });
  row("local viewer: direct", "shader", "on   shader: direct: the viewer's direction changes from ray to ray",
      [](Asked& a) {
        a.scene.lights.resize(40);
        a.scene.shading.localViewer = true;
      });
  row("sharp highlight: direct", "shader", "on   shader: direct: a shininess of 500 is too sharp for a map",
      [](Asked& a) {
        a.scene.lights.resize(40);
        a.scene.shading.shininess = 500;
      });
  row("a table is only taken where asked for", "shader",
      "on   shader: table of 32 densities and 31 steps of each gradient component in 8 bits, as asked: bands",
      [](Asked& a) { a.options.shader = Shader::table; });
  row("a map's size asks for a map", "shader",
      "on   shader: reflectance map of 16 x 16 a face, bilinear, as asked",
      [](Asked& a) { a.options.mapSize = 16; });
  row("the paper's map", "shader",
      "on   shader: reflectance map of 128 x 128 a face, nearest, as asked: directions off by up to 0.6328 "
      "degrees",
      [](Asked& a) { a.options.mapLookup = MapLookup::nearest; });
  row("planes by itself", "method",
      "on   method: planes: rays from front to back, so that what is hidden is never shaded", [](Asked&) {});
  row("planes by itself, unlit and with much that is hidden", "method",
      "on   method: planes: rays from front to back, so that what is hidden is never shaded; predicted 0.47 "
      "of the time of blend",
      [](Asked& a) {
        a.scene.shading.lit = false;
        a.scene.transferFunction.points[1].opacity = 1;
        a.facts.geometry.size.y = 64;
      });
  row("planes of a projection", "method",
      "on   method: planes: rays from front to back, each looked at from end to end",
      [](Asked& a) { a.scene.mode = Mode::mip; });
  row("planes by OpenGL", "method",
      "on   method: planes: rays from front to back, so that what is hidden is never shaded",
      [](Asked& a) { a.options.resampler = Resampler::gl; });
  row("blend as asked", "method",
      "on   method: blend, as asked: slices from the back to the front, each shaded, then blended; its steps "
      "do not see what lies between, so no error is promised",
      [](Asked& a) { a.options.method = Method::blend; });
  row("preshaded as asked", "method",
      "on   method: preshaded, as asked: colours of voxels are interpolated, not values, which is wrong "
      "where "
      "the curve is not straight",
      [](Asked& a) { a.options.method = Method::preshaded; });
  row("the GPU draws by OpenGL", "resampler", "on   resampler: gl: filtered by the texture hardware",
      [](Asked& a) { a.options.method = Method::gpu; });
  row("preshaded colours are interpolated in floats", "resampler",
      "on   resampler: gl, as asked: colours are interpolated in floats", [](Asked& a) {
        a.options.method = Method::preshaded;
        a.options.resampler = Resampler::gl;
      });
  row("planes blend nothing", "blending", "off  blending: rays are composited one by one, in floats",
      [](Asked&) {});
  row("a frame buffer of 8 bits", "blending",
      "on   blending: 8 bits, as asked: up to half of 1/255 is rounded off after each slice, and what is "
      "above 1 cut off",
      [](Asked& a) {
        a.options.method = Method::blend;
        a.options.blending = Blending::bits8;
      });
  row("unlit: no table", "shader", "off  shader: nothing is lit", [](Asked& a) {
    a.options.shader = Shader::table;
    a.scene.shading.lit = false;
  });
}

void TestChoiceRules::aChoiceSaysWhatAndWhy() { compareLine(); }

void TestChoiceRules::fullChoosesAlike_data() {
  QTest::addColumn<Change>("change");
  QTest::newRow("direct") << Change([](Asked&) {});
  QTest::newRow("map") << Change([](Asked& a) { a.scene.lights.resize(40); });
  // Full lights them with highlights of strength 0.
  QTest::newRow("direct, no highlights") << Change([](Asked& a) {
    a.scene.lights.resize(40);
    a.scene.shading.specular = 0;
  });
}

void TestChoiceRules::fullChoosesAlike() {
  QFETCH(Change, change);
  Asked asked;
  change(asked);
  const Plan lean = *makePlan(asked.scene, asked.facts, asked.options);
  asked.options.full = true;
  const Plan full = *makePlan(asked.scene, asked.facts, asked.options);
  QCOMPARE(full.shader, lean.shader);
  QCOMPARE(full.method, lean.method);
}

VOLUMEN_TEST(TestChoiceRules);
#include "tst_choice_rules.moc"
