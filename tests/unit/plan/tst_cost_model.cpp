// Guards the planner's cost model (design.md 5): predictions grow with their inputs. Planes are the cheapest
// method if much is hidden or steps are alike.
#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"
#include "viewer/plan/cost_model.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Plan planOf(const Asked& asked) { return *makePlan(asked.scene, asked.facts, asked.options); }

PredictedCost costOf(const Asked& asked, Shader shader) {
  return predictedCost(planOf(asked), asked.facts, shader);
}

}  // namespace

class TestCostModel : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void moreOfItCostsMore_data();
  void moreOfItCostsMore();
  void samplesAreTheBoxOverPixelAndStep_data();
  void samplesAreTheBoxOverPixelAndStep();
  void aMapCostsAlmostTheSameForAnyLights();
  void planesAreTheCheapest_data();
  void planesAreTheCheapest();
  void whatHidesSavesLight();
};

void TestCostModel::moreOfItCostsMore_data() {
  QTest::addColumn<Change>("more");
  QTest::addColumn<bool>("ofLight");
  const auto row = [](const char* name, bool ofLight, Change more) {
    QTest::newRow(name) << more << ofLight;
  };
  row("lights", true, [](Asked& a) { a.scene.lights.resize(2); });
  row("a shininess that is no whole number", true, [](Asked& a) { a.scene.shading.shininess = 20.5; });
  row("a light with a colour", true, [](Asked& a) { a.scene.lights[0].colour = {1, 0.5, 0.5}; });
  row("pixels", true, [](Asked& a) { a.options.size = {600, 600}; });
  row("a smaller budget", true, [](Asked& a) { a.options.quality = Quality::high; });
  row("a longer box", true, [](Asked& a) { a.facts.geometry.size.y = 9; });
  row("visible blocks", true, [](Asked& a) { a.scene.transferFunction.points[0].value = -950; });
  row("a nearer camera", false, [](Asked& a) {
    a.scene.camera = Camera{};
    a.scene.camera->height = 5;
  });
}

void TestCostModel::moreOfItCostsMore() {
  QFETCH(Change, more);
  QFETCH(bool, ofLight);
  // The matter is faint, so that it hides nothing.
  Asked asked;
  asked.scene.transferFunction.points = {{150, {}, 0}, {400, {}, 0.01}};
  const PredictedCost before = costOf(asked, Shader::phong);
  more(asked);
  const PredictedCost after = costOf(asked, Shader::phong);
  QVERIFY(before.samplingNs > 0 && before.lightNs > 0);
  QVERIFY(after.ns() > before.ns());
  if (ofLight) QVERIFY(after.lightNs > before.lightNs);
}

void TestCostModel::samplesAreTheBoxOverPixelAndStep_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<double>("samples");
  // 16 x 8 x 8 mm in pixels of 0.1 mm and steps of 2 mm, from any side.
  QTest::newRow("from the front") << Change([](Asked&) {}) << 16 * 8 * 8 / 0.01 / 2;
  QTest::newRow("from the left") << Change([](Asked& a) {
    a.scene.camera->direction = {1, 0, 0};
  }) << 16 * 8 * 8 / 0.01 / 2;
  QTest::newRow("half of it clipped")
      << Change([](Asked& a) { a.scene.clip.boxHigh.z = 0.5; }) << 16 * 8 * 8 / 0.01 / 2 / 2;
  // The box is 8 mm deep at every pixel.
  QTest::newRow("nearer than all of it")
      << Change([](Asked& a) { a.scene.camera->height = 4; }) << 200 * 200 * 8 / 2.0;
  QTest::newRow("nothing left") << Change([](Asked& a) { a.scene.clip.boxHigh = a.scene.clip.boxLow; })
                                << 0.0;
}

void TestCostModel::samplesAreTheBoxOverPixelAndStep() {
  QFETCH(Change, change);
  QFETCH(double, samples);
  Asked asked;
  asked.scene.camera = Camera{};
  asked.scene.camera->height = 20;
  asked.options.size = {200, 200};
  asked.options.step = 2;
  change(asked);
  const double predicted = samplesInBox(planOf(asked), asked.facts.geometry);
  QVERIFY2(std::abs(predicted - samples) <= 1e-9 * samples, qPrintable(QString::number(predicted)));
}

// Only the map's nodes evaluate every light. A large picture has more samples than a map has nodes.
void TestCostModel::aMapCostsAlmostTheSameForAnyLights() {
  Asked asked;
  asked.options.size = {1024, 1024};
  const double one = costOf(asked, Shader::map).lightNs;
  asked.scene.lights.resize(16);
  const double many = costOf(asked, Shader::map).lightNs;
  QVERIFY(many > one && many < 1.5 * one);
  QVERIFY(costOf(asked, Shader::phong).lightNs > many / 2);
}

void TestCostModel::planesAreTheCheapest_data() {
  QTest::addColumn<Change>("change");
  // If nothing is hidden, integrating cell by cell is slower than the steps of slices, which promise nothing.
  QTest::newRow("unlit, opaque") << Change([](Asked& a) {
    a.scene.shading.lit = false;
    a.scene.transferFunction.points[1].opacity = 1;
    a.facts.geometry.size.y = 64;
  });
  QTest::newRow("plain steps") << Change([](Asked& a) { a.options.step = 1; });
}

void TestCostModel::planesAreTheCheapest() {
  QFETCH(Change, change);
  Asked asked;
  change(asked);
  const Plan planes = planOf(asked);
  const double ns = predictedCost(planes, asked.facts).ns();
  asked.options.method = Method::blend;
  // If nothing is hidden, plain steps cost the same with either method.
  QVERIFY(ns <= predictedCost(planOf(asked), asked.facts).ns());
  asked.options.method = Method::planes;
  asked.options.resampler = Resampler::gl;
  QVERIFY(ns < predictedCost(planOf(asked), asked.facts).ns());
}

void TestCostModel::whatHidesSavesLight() {
  Asked asked;
  asked.options.step = 1;
  asked.scene.transferFunction.points = {{150, {}, 0}, {151, {}, 0.01}};
  const double faint = costOf(asked, Shader::phong).lightNs;
  asked.scene.transferFunction.points[1].opacity = 1;
  QVERIFY(costOf(asked, Shader::phong).lightNs < faint / 2);
  // A ray that never stops samples all of the matter.
  asked.options.stopAt = 0;
  QCOMPARE(costOf(asked, Shader::phong).lightNs, faint);
}

VOLUMEN_TEST(TestCostModel);
#include "tst_cost_model.moc"
