// Guards DESIGN 5: each rule of the planner alone, the negative case beside the positive.
#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"
#include "viewer/plan/rules.h"

using namespace volumen;
using namespace volumen::tests;

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
  row("lit", "lighting", "on   lighting: the scene is lit by 1 of 1 lights", [](Asked&) {});
  row("unlit: no light", "lighting", "off  lighting: the scene is unlit",
      [](Asked& a) { a.scene.shading.lit = false; });
  row("a light that is off does not shine", "lighting", "on   lighting: the scene is lit by 0 of 1 lights",
      [](Asked& a) { a.scene.lights[0].on = false; });
  row("mip: no light", "lighting", "off  lighting: a projection of values has no lighting",
      [](Asked& a) { a.scene.mode = Mode::mip; });
  row("specular", "specular", "on   specular: the material's specular is 0.2", [](Asked&) {});
  row("no specular", "specular", "off  specular: the material's specular is 0",
      [](Asked& a) { a.scene.shading.specular = 0; });
  row("no light: no specular", "specular", "off  specular: no light shines",
      [](Asked& a) { a.scene.lights.clear(); });
  row("white light", "light colour",
      "off  light colour: no light has a colour: computed once for red, green and blue", [](Asked&) {});
  row("a red light", "light colour",
      "on   light colour: a light has a colour: computed for red, green and blue", [](Asked& a) {
        a.scene.lights[0].colour = {1, 0.5, 0.5};
      });
  row("a red light that is off", "light colour",
      "off  light colour: no light has a colour: computed once for red, green and blue", [](Asked& a) {
        a.scene.lights.push_back(a.scene.lights[0]);
        a.scene.lights[1].colour = {1, 0, 0};
        a.scene.lights[1].on = false;
      });
  row("unlit: no light has a colour", "light colour", "off  light colour: nothing is lit", [](Asked& a) {
    a.scene.lights[0].colour = {1, 0, 0};
    a.scene.shading.lit = false;
  });
  row("unlit: no gradients", "gradients",
      "off  gradients: neither light nor opacity asks for them: no Sobel pass, no memory",
      [](Asked& a) { a.scene.shading.lit = false; });
  row("lit: gradients", "gradients", "on   gradients: lighting needs the surface's direction", [](Asked&) {});
  row("unlit with gradient opacity: gradients", "gradients",
      "on   gradients: the gradient opacity needs them", [](Asked& a) {
        a.scene.shading.lit = false;
        a.scene.transferFunction.gradientOpacity = {{0, 0}, {10, 1}};
      });
  row("a factor of 1 is no gradient opacity", "gradient opacity",
      "off  gradient opacity: its factor is 1 at every gradient", [](Asked& a) {
        a.scene.transferFunction.gradientOpacity = {{5, 1}};
      });
  row("no clip", "clip", "off  clip: the clip box is the whole volume and there are no planes",
      [](Asked&) {});
  row("clip box", "clip", "on   clip: a clip box and 0 planes cut the rays",
      [](Asked& a) { a.scene.clip.boxHigh.x = 0.5; });
  row("clip plane", "clip", "on   clip: no clip box and 1 planes cut the rays",
      [](Asked& a) { a.scene.clip.planes.push_back({}); });
  row("air is skipped", "empty blocks", "on   empty blocks: 50 % of the blocks hold no visible value",
      [](Asked&) {});
  row("visible air is not", "empty blocks", "off  empty blocks: every block holds a visible value",
      [](Asked& a) { a.scene.transferFunction.points[0].opacity = 0.1; });
  row("unknown blocks are not", "empty blocks", "off  empty blocks: nothing is known of the blocks",
      [](Asked& a) { a.facts.blockRanges = nullptr; });
  row("standard: a fifth of a unit may be behind", "early stop",
      "on   early stop: a ray ends where less than 1/1275 of the light behind comes through",
      [](Asked& a) { a.scene.shading.specular = 0; });
  row("bright light: rays end later", "early stop",
      "on   early stop: a ray ends where less than 1/11730 of the light behind comes through",
      [](Asked& a) { a.scene.lights[0].intensity = 10; });
  row("high: rays end later", "early stop",
      "on   early stop: a ray ends where less than 1/4096 of the light behind comes through",
      [](Asked& a) { a.options.quality = Quality::high; });
  row("high, bright light", "early stop",
      "on   early stop: a ray ends where less than 1/11730 of the light behind comes through", [](Asked& a) {
        a.options.quality = Quality::high;
        a.scene.lights[0].intensity = 10;
      });
  row("steps of half a voxel: rays end later", "early stop",
      "on   early stop: a ray ends where less than 1/16384 of the light behind comes through",
      [](Asked& a) { a.options.step = 0.5; });
  row("longer steps do not", "early stop",
      "on   early stop: a ray ends where less than 1/4096 of the light behind comes through",
      [](Asked& a) { a.options.step = 0.6; });
  row("integers in 16 bits", "precision", "on   precision: 16 bits hold the stored integers exactly",
      [](Asked&) {});
  row("gradients of integers beside extreme values", "precision",
      "on   precision: 32 bits: gradients packed into 16 bits would be too coarse beside a few extreme "
      "values",
      [](Asked& a) {
        a.facts.range = {-32768, 32767};
        a.scene.shading.gradientFloor = 10;
      });
  row("the same, unlit", "precision", "on   precision: 16 bits hold the stored integers exactly",
      [](Asked& a) {
        a.facts.range = {-32768, 32767};
        a.scene.shading.gradientFloor = 10;
        a.scene.shading.lit = false;
      });
  row("gradients of zeros and ones are exact", "precision",
      "on   precision: 16 bits hold the stored integers exactly", [](Asked& a) {
        a.facts.range = {0, 1};
        a.facts.p01 = 0;
        a.facts.p999 = 1;
      });
  row("but not by Zucker and Hummel, whose weights are roots", "precision",
      "on   precision: 32 bits: gradients packed into 16 bits would be too coarse beside a few extreme "
      "values",
      [](Asked& a) {
        a.facts.range = {0, 1};
        a.facts.p01 = 0;
        a.facts.p999 = 1;
        a.options.gradient = GradientOperator::zuckerHummel;
      });
  row("bytes of many values", "precision",
      "on   precision: 8 bits, as asked: values rounded to 1/255 of their range, gradients to 1/127 of the "
      "largest",
      [](Asked& a) { a.options.precision = 8; });
  row("bytes of 256 values", "precision",
      "on   precision: 8 bits, as asked: values kept exactly, gradients to 1/127 of the largest",
      [](Asked& a) {
        a.options.precision = 8;
        a.facts.range = {-27.5, 100};
        a.facts.rescaleSlope = -0.5;
      });
  row("bytes of floats, unlit", "precision",
      "on   precision: 8 bits, as asked: values rounded to 1/255 of their range", [](Asked& a) {
        a.options.precision = 8;
        a.facts.integers = false;
        a.facts.range = {0, 1};
        a.scene.shading.lit = false;
      });
  row("plain filters are too coarse for high", "precision",
      "on   precision: 32 bits, interpolated in floats: filters of texture hardware are too coarse here",
      [](Asked& a) {
        a.options.resampler = Resampler::gl;
        a.options.quality = Quality::high;
      });
  row("floats in 32 bits", "precision",
      "on   precision: 32 bits: 16-bit integers with a positive slope do not hold the values",
      [](Asked& a) { a.facts.integers = false; });
  row("a negative slope in 32 bits", "precision",
      "on   precision: 32 bits: 16-bit integers with a positive slope do not hold the values",
      [](Asked& a) { a.facts.rescaleSlope = -1; });
  row("slices pass over air too", "empty blocks",
      "on   empty blocks: 50 % of the blocks hold no visible value",
      [](Asked& a) { a.options.method = Method::blend; });
  row("slices by OpenGL skip no blocks", "empty blocks",
      "off  empty blocks: this method looks at every sample", [](Asked& a) {
        a.options.method = Method::blend;
        a.options.resampler = Resampler::gl;
      });
  row("a maximum passes over smaller values", "empty blocks",
      "on   empty blocks: what holds nothing larger than a ray has met is passed over",
      [](Asked& a) { a.scene.mode = Mode::mip; });
  row("a minimum passes over larger values", "empty blocks",
      "on   empty blocks: what holds nothing smaller than a ray has met is passed over",
      [](Asked& a) { a.scene.mode = Mode::minip; });
  row("a mean passes over nothing", "empty blocks", "off  empty blocks: a mean looks at every value",
      [](Asked& a) { a.scene.mode = Mode::average; });
  row("a maximum by OpenGL passes over nothing", "empty blocks",
      "off  empty blocks: OpenGL resamples every value of a projection", [](Asked& a) {
        a.scene.mode = Mode::mip;
        a.options.resampler = Resampler::gl;
      });
  row("a maximum of unknown blocks", "empty blocks", "off  empty blocks: nothing is known of the blocks",
      [](Asked& a) {
        a.scene.mode = Mode::mip;
        a.facts.blockRanges.reset();
      });
  row("a maximum in full", "empty blocks", "off  empty blocks: asked for in full", [](Asked& a) {
    a.scene.mode = Mode::mip;
    a.options.full = true;
  });
  row("preshaded skips no blocks", "empty blocks", "off  empty blocks: this method looks at every sample",
      [](Asked& a) { a.options.method = Method::preshaded; });
  row("slices of what hides little", "early stop",
      "off  early stop: too little is hidden for finding it from the front first",
      [](Asked& a) { a.options.method = Method::blend; });
  row("slices of what hides much", "early stop",
      "on   early stop: what lies where less than 1/1275 of the light behind comes through is not blended: "
      "found from the front first",
      [](Asked& a) {
        a.scene.shading.specular = 0;
        a.options.method = Method::blend;
        a.scene.transferFunction.points[1].opacity = 1;
        a.facts.geometry.size.y = 64;
      });
  row("slices that stop as asked", "early stop",
      "on   early stop: what lies where less than 0.02 of the light behind comes through is not blended: "
      "found "
      "from the front first, as asked",
      [](Asked& a) {
        a.options.method = Method::blend;
        a.options.stopAt = 0.02;
      });
  row("every slice as asked", "early stop", "off  early stop: every slice is blended, as asked",
      [](Asked& a) {
        a.options.method = Method::blend;
        a.options.stopAt = 0;
      });
  row("slices that are rounded fade into values of their own", "early stop",
      "off  early stop: slices that are rounded hide nothing for good", [](Asked& a) {
        a.options.method = Method::blend;
        a.options.blending = Blending::bits8;
        a.scene.transferFunction.points[1].opacity = 1;
        a.facts.geometry.size.y = 64;
      });
  row("slices by OpenGL never stop", "early stop",
      "off  early stop: what comes from the back cannot know what will hide it", [](Asked& a) {
        a.options.method = Method::blend;
        a.options.resampler = Resampler::gl;
        a.scene.transferFunction.points[1].opacity = 1;
        a.facts.geometry.size.y = 64;
      });
  row("Sobel", "gradient operator",
      "on   gradient operator: Sobel, over all 26 neighbours: smooth, and turns with the object",
      [](Asked&) {});
  row("central differences", "gradient operator", "on   gradient operator: central differences, as asked",
      [](Asked& a) { a.options.gradient = GradientOperator::central; });
  row("no gradients, no operator", "gradient operator", "off  gradient operator: there are no gradients",
      [](Asked& a) { a.scene.shading.lit = false; });
  row("a ray ends as asked", "early stop",
      "on   early stop: a ray ends where less than 0.02 of the light behind comes through, as asked",
      [](Asked& a) { a.options.stopAt = 0.02; });
  row("no ray ends", "early stop", "off  early stop: every ray is followed to its end, as asked",
      [](Asked& a) { a.options.stopAt = 0; });
  row("the exact curve", "curve table", "off  curve table: the curve is followed exactly, point by point",
      [](Asked&) {});
  row("a table", "curve table",
      "on   curve table: the nearest of 256 entries over the volume's values, as asked",
      [](Asked& a) { a.options.curveTable = 256; });
  row("every sample counts", "faint samples", "off  faint samples: every sample that has any opacity counts",
      [](Asked&) {});
  row("faint samples, over half a unit distance", "faint samples",
      "on   faint samples: samples of opacity below 0.1 are passed over, as asked (0.19 per unit distance)",
      [](Asked& a) {
        a.options.step = 0.5;
        a.options.opacityThreshold = 0.1;
      });
  row("blocks of faint values alone are empty", "empty blocks",
      "on   empty blocks: 100 % of the blocks hold no visible value", [](Asked& a) {
        a.options.step = 1;
        a.options.opacityThreshold = 0.9;
      });
  row("the reference decides nothing", "reference",
      "on   reference: everything, adaptively, cell by cell, in double precision",
      [](Asked& a) { a.options.method = Method::reference; });
}

void TestRules::aRuleSaysWhatAndWhy() { compareLine(); }

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
  // Of plain steps: levels ask cells in full, too.
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
  // SCENE 5: (P99.9 - P0.1) / 32 / cbrt(|det L|), and the default window P0.1 .. P99.9.
  QCOMPARE(*plan.scene.shading.gradientFloor, 1900.0 / 32);
  QCOMPARE(*plan.scene.window, (Window{-50, 1900}));
}

VOLUMEN_TEST(TestRules);
#include "tst_rules.moc"
