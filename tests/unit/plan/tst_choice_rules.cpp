// Guards design.md 5: the choices of method, resampler and shader. Open choices are made by the cost model.
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
  row("the CPU resamples", "resampler", "on cpu empty opaque every machine", [](Asked&) {});
  row("the CPU resamples a projection", "resampler", "on cpu every machine !opaque",
      [](Asked& a) { a.scene.mode = Mode::mip; });
  row("OpenGL resamples", "resampler", "on gl asked texture no error",
      [](Asked& a) { a.options.resampler = Resampler::gl; });
  row("one light: direct", "shader", "on 1 0.097 direct map", [](Asked&) {});
  row("three lights: still direct", "shader", "on 3 0.29 direct map",
      [](Asked& a) { a.scene.lights.resize(3); });
  row("forty lights: map", "shader", "on 40 0.27 map direct", [](Asked& a) { a.scene.lights.resize(40); });
  row("thirty lights without highlights: direct", "shader", "on 30 0.92 direct map", [](Asked& a) {
    a.scene.lights.resize(30);
    a.scene.shading.specular = 0;
  });
  row("eight lights, a whole shininess: direct", "shader", "on 8 0.77 direct map",
      [](Asked& a) { a.scene.lights.resize(8); });
  row("eight lights, one of them red: direct", "shader", "on 8 0.39 direct map", [](Asked& a) {
    a.scene.lights.resize(8);
    a.scene.lights[3].colour = {1, 0, 0};
  });
  row("sixteen lights, any other shininess: map", "shader", "on 16 0.22 map direct", [](Asked& a) {
    a.scene.lights.resize(16);
    a.scene.shading.shininess = 20.5;
  });
  row("the same in few pixels: a map has more nodes than the picture samples", "shader",
      "on 16 0.26 direct map", [](Asked& a) {
        a.scene.lights.resize(16);
        a.scene.shading.shininess = 20.5;
        a.options.size = {32, 32};
      });
  row("lights that are off cost nothing", "shader", "on 1 0.097 direct map", [](Asked& a) {
    a.scene.lights.resize(40);
    for (int n = 1; n < 40; ++n) a.scene.lights[n].on = false;
  });
  row("no light shines", "shader", "on direct no light", [](Asked& a) { a.scene.lights.clear(); });
  row("exact: direct", "shader", "on direct exact", [](Asked& a) {
    a.scene.lights.resize(40);
    a.options.quality = Quality::exact;
  });
  row("local viewer: direct", "shader", "on direct viewer", [](Asked& a) {
    a.scene.lights.resize(40);
    a.scene.shading.localViewer = true;
  });
  row("sharp highlight: direct", "shader", "on 500 direct shininess", [](Asked& a) {
    a.scene.lights.resize(40);
    a.scene.shading.shininess = 500;
  });
  row("a table is only taken where asked for", "shader", "on 32 31 8 bits table asked",
      [](Asked& a) { a.options.shader = Shader::table; });
  row("a map's size asks for a map", "shader", "on 16 16 map bilinear asked",
      [](Asked& a) { a.options.mapSize = 16; });
  row("the paper's map", "shader", "on 128 128 0.6328 map nearest asked degrees",
      [](Asked& a) { a.options.mapLookup = MapLookup::nearest; });
  row("planes by itself", "method", "on planes hidden", [](Asked&) {});
  row("planes by itself, unlit and with much that is hidden", "method", "on 0.47 planes hidden blend",
      [](Asked& a) {
        a.scene.shading.lit = false;
        a.scene.transferFunction.points[1].opacity = 1;
        a.facts.geometry.size.y = 64;
      });
  row("planes of a projection", "method", "on planes end", [](Asked& a) { a.scene.mode = Mode::mip; });
  row("planes by OpenGL", "method", "on planes hidden",
      [](Asked& a) { a.options.resampler = Resampler::gl; });
  row("blend as asked", "method", "on blend asked no error",
      [](Asked& a) { a.options.method = Method::blend; });
  row("preshaded as asked", "method", "on preshaded asked wrong",
      [](Asked& a) { a.options.method = Method::preshaded; });
  row("the GPU draws by OpenGL", "resampler", "on gl texture !asked",
      [](Asked& a) { a.options.method = Method::gpu; });
  row("preshaded colours are interpolated in floats", "resampler", "on gl asked colours floats",
      [](Asked& a) {
        a.options.method = Method::preshaded;
        a.options.resampler = Resampler::gl;
      });
  row("planes blend nothing", "blending", "off composited", [](Asked&) {});
  row("a frame buffer of 8 bits", "blending", "on 8 bits 1/255 1 asked rounded", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.blending = Blending::bits8;
  });
  row("unlit: no table", "shader", "off nothing lit", [](Asked& a) {
    a.options.shader = Shader::table;
    a.scene.shading.lit = false;
  });
}

void TestChoiceRules::aChoiceSaysWhatAndWhy() { compareEffect(); }

void TestChoiceRules::fullChoosesAlike_data() {
  QTest::addColumn<Change>("change");
  QTest::newRow("direct") << Change([](Asked&) {});
  QTest::newRow("map") << Change([](Asked& a) { a.scene.lights.resize(40); });
  // --full lights them too, with highlights of strength 0.
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
