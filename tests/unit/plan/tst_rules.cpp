// Guards design.md 5: each rule of the planner alone, with positive and negative cases.
#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"
#include "viewer/plan/rules.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// An unlit scene of 16-bit values whose gradient opacity rises within `width`.
void setRamp(Asked& a, double width) {
  a.facts.range = {-32768, 32767};
  a.scene.shading.lit = false;
  a.scene.transferFunction.gradientOpacity = {{1000, 0}, {1000 + width, 1}, {9000, 1}};
}

// Values are unsigned, and the stored value of density 0 is far from the rise.
void narrowRise(Asked& a) {
  a.facts.densityZero = 32768;
  a.scene.transferFunction.points = {{100, {}, 0}, {101, {}, 0.5}};
}

void showSegments(Asked& a, int count) {
  OccupancyField field;
  field.values = {1};
  const auto shared = std::make_shared<const OccupancyField>(field);
  a.scene.segments.assign(std::size_t(count), {shared, glm::dvec3(1), 0.5});
}

}  // namespace

class TestRules : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aRuleSaysWhatAndWhy_data();
  void aRuleSaysWhatAndWhy();
  void fullSwitchesEverySoundRuleOffAndKeepsTheChoices();
  void aPlanIsAPureFunction();
  void theSceneIsCompleted();
};

void TestRules::aRuleSaysWhatAndWhy_data() {
  addRuleColumns();
  const auto row = addRuleRow;
  row("lit", "lighting", "on 1 1 lights", [](Asked&) {});
  row("unlit: no light", "lighting", "off unlit", [](Asked& a) { a.scene.shading.lit = false; });
  row("a light that is off does not shine", "lighting", "on 0 1 lights",
      [](Asked& a) { a.scene.lights[0].on = false; });
  row("mip: no light", "lighting", "off projection", [](Asked& a) { a.scene.mode = Mode::mip; });
  row("specular", "specular", "on 0.2 material", [](Asked&) {});
  row("no specular", "specular", "off 0 material", [](Asked& a) { a.scene.shading.specular = 0; });
  row("no light: no specular", "specular", "off no light", [](Asked& a) { a.scene.lights.clear(); });
  row("white light", "light colour", "off no colour once", [](Asked&) {});
  row("a red light", "light colour", "on red green blue", [](Asked& a) {
    a.scene.lights[0].colour = {1, 0.5, 0.5};
  });
  row("a red light that is off", "light colour", "off no colour once", [](Asked& a) {
    a.scene.lights.push_back(a.scene.lights[0]);
    a.scene.lights[1].colour = {1, 0, 0};
    a.scene.lights[1].on = false;
  });
  row("unlit: no light has a colour", "light colour", "off nothing lit", [](Asked& a) {
    a.scene.lights[0].colour = {1, 0, 0};
    a.scene.shading.lit = false;
  });
  row("unlit: no gradients", "gradients", "off neither light opacity",
      [](Asked& a) { a.scene.shading.lit = false; });
  row("lit: gradients", "gradients", "on lighting", [](Asked&) {});
  row("unlit with gradient opacity: gradients", "gradients", "on opacity", [](Asked& a) {
    a.scene.shading.lit = false;
    a.scene.transferFunction.gradientOpacity = {{0, 0}, {10, 1}};
  });
  row("a factor of 1 is no gradient opacity", "gradient opacity", "off 1 factor", [](Asked& a) {
    a.scene.transferFunction.gradientOpacity = {{5, 1}};
  });
  row("no clip", "clip", "off box planes", [](Asked&) {});
  row("clip box", "clip", "on 0 box planes !no", [](Asked& a) { a.scene.clip.boxHigh.x = 0.5; });
  row("clip plane", "clip", "on 1 no box planes", [](Asked& a) { a.scene.clip.planes.push_back({}); });
  row("no segments", "segments", "off no segment", [](Asked&) {});
  row("segments that do not show", "segments", "off no segment", [](Asked& a) {
    showSegments(a, 2);
    a.scene.segments[0].opacity = 0;
    a.scene.segments[1].field = std::make_shared<const OccupancyField>();
  });
  row("a segment", "segments", "on surface 1 segment", [](Asked& a) { showSegments(a, 1); });
  row("segments by plain steps", "segments", "on surfaces 3 segments", [](Asked& a) {
    showSegments(a, 3);
    a.options.step = 0.5;
  });
  row("a projection has no surfaces", "segments", "off projection", [](Asked& a) {
    showSegments(a, 1);
    a.scene.mode = Mode::mip;
  });
  row("slices meet no surfaces", "segments", "off planes reference", [](Asked& a) {
    showSegments(a, 1);
    a.options.method = Method::blend;
  });
  row("OpenGL meets no surfaces", "segments", "off planes reference", [](Asked& a) {
    showSegments(a, 1);
    a.options.resampler = Resampler::gl;
  });
  row("air is skipped", "empty blocks", "on 50 % no visible", [](Asked&) {});
  row("visible air is not", "empty blocks", "off every visible",
      [](Asked& a) { a.scene.transferFunction.points[0].opacity = 0.1; });
  row("unknown blocks are not", "empty blocks", "off nothing known",
      [](Asked& a) { a.facts.blockRanges = nullptr; });
  row("standard: a fifth of a unit may be behind", "early ray termination", "on 1/1275 ray",
      [](Asked& a) { a.scene.shading.specular = 0; });
  row("bright light: rays end later", "early ray termination", "on 1/11730 ray",
      [](Asked& a) { a.scene.lights[0].intensity = 10; });
  row("high: rays end later", "early ray termination", "on 1/4096 ray",
      [](Asked& a) { a.options.quality = Quality::high; });
  row("high, bright light", "early ray termination", "on 1/11730 ray", [](Asked& a) {
    a.options.quality = Quality::high;
    a.scene.lights[0].intensity = 10;
  });
  row("steps of half a voxel: rays end later", "early ray termination", "on 1/16384 ray",
      [](Asked& a) { a.options.step = 0.5; });
  row("longer steps do not", "early ray termination", "on 1/4096 ray",
      [](Asked& a) { a.options.step = 0.6; });
  row("integers in 16 bits", "precision", "on 16 bits integers exactly", [](Asked&) {});
  row("gradients of integers beside extreme values", "precision",
      "on 32 bits 16 bits gradients coarse extreme", [](Asked& a) {
        a.facts.range = {-32768, 32767};
        a.scene.shading.gradientFloor = 10;
      });
  row("the same, unlit", "precision", "on 16 bits integers exactly", [](Asked& a) {
    a.facts.range = {-32768, 32767};
    a.scene.shading.gradientFloor = 10;
    a.scene.shading.lit = false;
  });
  row("a ramp of gradient opacity is wide beside roundings of gradients", "precision",
      "on 16 bits integers exactly", [](Asked& a) { setRamp(a, 4000); });
  row("a steep one is not", "precision", "on 32 bits 16 bits gradients coarse extreme",
      [](Asked& a) { setRamp(a, 10); });
  row("nor is a step", "precision", "on 32 bits 16 bits gradients coarse extreme",
      [](Asked& a) { setRamp(a, 0); });
  row("gradients of zeros and ones are exact", "precision", "on 16 bits integers exactly", [](Asked& a) {
    a.facts.range = {0, 1};
    a.facts.p01 = 0;
    a.facts.p999 = 1;
  });
  row("but not by Zucker and Hummel, whose weights are roots", "precision",
      "on 32 bits 16 bits gradients coarse extreme", [](Asked& a) {
        a.facts.range = {0, 1};
        a.facts.p01 = 0;
        a.facts.p999 = 1;
        a.options.gradient = GradientOperator::zuckerHummel;
      });
  row("a curve that rises within few roundings of unsigned samples", "precision",
      "on 32 bits 16 bits curve few coarse", narrowRise);
  row("near density 0 floats are finer", "precision", "on 16 bits integers exactly", [](Asked& a) {
    narrowRise(a);
    a.facts.densityZero = 0;
  });
  row("a projection has no curve", "precision", "on 16 bits integers exactly", [](Asked& a) {
    narrowRise(a);
    a.scene.mode = Mode::mip;
  });
  row("bytes of many values", "precision", "on 8 bits 1/255 1/127 asked values rounded gradients",
      [](Asked& a) { a.options.precision = 8; });
  row("bytes of 256 values", "precision", "on 8 bits 1/127 asked values exactly gradients", [](Asked& a) {
    a.options.precision = 8;
    a.facts.range = {-27.5, 100};
    a.facts.rescaleSlope = -0.5;
  });
  row("bytes of floats, unlit", "precision", "on 8 bits 1/255 asked values rounded !gradients", [](Asked& a) {
    a.options.precision = 8;
    a.facts.integers = false;
    a.facts.range = {0, 1};
    a.scene.shading.lit = false;
  });
  row("plain filters are too coarse for high", "precision", "on 32 bits filters coarse", [](Asked& a) {
    a.options.resampler = Resampler::gl;
    a.options.quality = Quality::high;
  });
  row("floats in 32 bits", "precision", "on 32 bits 16 slope not",
      [](Asked& a) { a.facts.integers = false; });
  row("a negative slope in 32 bits", "precision", "on 32 bits 16 slope not",
      [](Asked& a) { a.facts.rescaleSlope = -1; });
  row("slices pass over air too", "empty blocks", "on 50 % no visible",
      [](Asked& a) { a.options.method = Method::blend; });
  row("slices by OpenGL skip no blocks", "empty blocks", "off every sample", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.resampler = Resampler::gl;
  });
  row("a maximum passes over smaller values", "empty blocks", "on larger",
      [](Asked& a) { a.scene.mode = Mode::mip; });
  row("a minimum passes over larger values", "empty blocks", "on smaller",
      [](Asked& a) { a.scene.mode = Mode::minip; });
  row("a mean passes over nothing", "empty blocks", "off mean",
      [](Asked& a) { a.scene.mode = Mode::average; });
  row("a maximum by OpenGL passes over nothing", "empty blocks", "off OpenGL projection", [](Asked& a) {
    a.scene.mode = Mode::mip;
    a.options.resampler = Resampler::gl;
  });
  row("a maximum of unknown blocks", "empty blocks", "off nothing known", [](Asked& a) {
    a.scene.mode = Mode::mip;
    a.facts.blockRanges.reset();
  });
  row("a maximum in full", "empty blocks", "off full", [](Asked& a) {
    a.scene.mode = Mode::mip;
    a.options.full = true;
  });
  row("preshaded skips no blocks", "empty blocks", "off every sample",
      [](Asked& a) { a.options.method = Method::preshaded; });
  row("slices of what hides little", "early ray termination", "off little",
      [](Asked& a) { a.options.method = Method::blend; });
  row("slices of what hides much", "early ray termination", "on 1/1275 blended", [](Asked& a) {
    a.scene.shading.specular = 0;
    a.options.method = Method::blend;
    a.scene.transferFunction.points[1].opacity = 1;
    a.facts.geometry.size.y = 64;
  });
  row("slices that stop as asked", "early ray termination", "on 0.02 blended asked", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.stopAt = 0.02;
  });
  row("every slice as asked", "early ray termination", "off slice asked", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.stopAt = 0;
  });
  row("slices that are rounded fade into values of their own", "early ray termination", "off rounded",
      [](Asked& a) {
        a.options.method = Method::blend;
        a.options.blending = Blending::bits8;
        a.scene.transferFunction.points[1].opacity = 1;
        a.facts.geometry.size.y = 64;
      });
  row("slices by OpenGL never stop", "early ray termination", "off back", [](Asked& a) {
    a.options.method = Method::blend;
    a.options.resampler = Resampler::gl;
    a.scene.transferFunction.points[1].opacity = 1;
    a.facts.geometry.size.y = 64;
  });
  row("Sobel", "gradient operator", "on 26 Sobel", [](Asked&) {});
  row("central differences", "gradient operator", "on central asked",
      [](Asked& a) { a.options.gradient = GradientOperator::central; });
  row("no gradients, no operator", "gradient operator", "off no gradients",
      [](Asked& a) { a.scene.shading.lit = false; });
  row("a ray ends as asked", "early ray termination", "on 0.02 ray asked",
      [](Asked& a) { a.options.stopAt = 0.02; });
  row("no ray ends", "early ray termination", "off ray asked", [](Asked& a) { a.options.stopAt = 0; });
  row("the exact curve", "curve table", "off exactly", [](Asked&) {});
  row("a table", "curve table", "on 256 nearest asked", [](Asked& a) { a.options.curveTable = 256; });
  row("every sample counts", "faint samples", "off every", [](Asked&) {});
  row("faint samples, over half a unit distance", "faint samples", "on 0.1 0.19 passed asked", [](Asked& a) {
    a.options.step = 0.5;
    a.options.opacityThreshold = 0.1;
  });
  row("blocks of faint values alone are empty", "empty blocks", "on 100 % no visible", [](Asked& a) {
    a.options.step = 1;
    a.options.opacityThreshold = 0.9;
  });
  row("the reference decides nothing", "reference", "on cell double",
      [](Asked& a) { a.options.method = Method::reference; });
}

void TestRules::aRuleSaysWhatAndWhy() { compareEffect(); }

void TestRules::fullSwitchesEverySoundRuleOffAndKeepsTheChoices() {
  Asked asked;
  asked.scene.shading.lit = false;
  const Plan lean = *makePlan(asked.scene, asked.facts, asked.options);
  asked.options.full = true;
  const Plan full = *makePlan(asked.scene, asked.facts, asked.options);
  QVERIFY(full.lit && full.gradients && full.specular && full.colouredLight && full.clip &&
          full.gradientOpacity && !full.skipBlocks);
  QVERIFY(!lean.lit && !lean.gradients && !lean.specular && !lean.colouredLight && !lean.clip &&
          !lean.gradientOpacity && lean.skipBlocks);
  QCOMPARE(full.stepVoxels, lean.stepVoxels);
  QCOMPARE(full.stopTransmittance, lean.stopTransmittance);
  QCOMPARE(full.bits, lean.bits);
  // This applies to plain steps only. Levels ask cells with --full too.
  asked.options.step = 1;
  asked.scene.transferFunction.points = {{600, {1, 1, 1}, 0}, {1000, {1, 1, 1}, 1}};
  QVERIFY(!makePlan(asked.scene, asked.facts, asked.options)->skipCells);
  asked.options.full = false;
  QVERIFY(makePlan(asked.scene, asked.facts, asked.options)->skipCells);
}

void TestRules::aPlanIsAPureFunction() {
  const Asked asked;
  QVERIFY(*makePlan(asked.scene, asked.facts, asked.options) ==
          *makePlan(asked.scene, asked.facts, asked.options));
}

void TestRules::theSceneIsCompleted() {
  Asked asked;
  const Plan plan = *makePlan(asked.scene, asked.facts, asked.options);
  QVERIFY(plan.scene.camera && plan.scene.camera->target && plan.scene.window &&
          plan.scene.shading.gradientFloor);
  // picture.md 5: (P99.9 - P0.1) / 32 / cbrt(|det L|), and the default window P0.1 .. P99.9.
  QCOMPARE(*plan.scene.shading.gradientFloor, 1900.0 / 32);
  QCOMPARE(*plan.scene.window, (Window{-50, 1900}));
}

VOLUMEN_TEST(TestRules);
#include "tst_rules.moc"
