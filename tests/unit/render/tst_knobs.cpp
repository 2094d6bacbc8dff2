// Guards that methods obey the options of design.md 6: thresholds, curve table, gradient operator.
#include <limits>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/render/picture_cases.h"
#include "tests/unit/suite.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

class TestKnobs : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aChangedCurveIsDrawnAsTheScenesOwn_data();
  void aChangedCurveIsDrawnAsTheScenesOwn();
  void faintSamplesAreNotTaken();
  void aSmallerToleranceTakesMorePartsAndErrsLess();
  void aRayEndsWhereAsked();
  void gradientOperatorsAgreeOnARamp();
};

namespace {

constexpr glm::ivec2 size(40, 40);

Rendered drawn(const Scene& scene, RenderCaches& caches, RenderOptions options) {
  options.size = size;
  if (!options.tolerance && options.method != Method::reference) options.step = options.step.value_or(1);
  return *render(*makePlan(scene, caches.facts(), options), caches);
}

const PictureCase& caseNamed(const std::string& name) {
  for (const PictureCase& c : pictureCases())
    if (c.name == name) return c;
  throw std::runtime_error(name);
}

const PictureCase& translucent() { return caseNamed("sheared grid, perspective"); }

}  // namespace

void TestKnobs::aChangedCurveIsDrawnAsTheScenesOwn_data() {
  QTest::addColumn<int>("entries");
  QTest::addColumn<double>("threshold");
  QTest::newRow("table of 2") << 2 << 0.;
  QTest::newRow("table of 33") << 33 << 0.;
  QTest::newRow("table of 4096") << 4096 << 0.;
  QTest::newRow("no faint samples") << 0 << 0.06;
  QTest::newRow("both") << 65 << 0.03;
}

// The brute-force renderer draws the same picture if the changed curve is the scene's.
void TestKnobs::aChangedCurveIsDrawnAsTheScenesOwn() {
  QFETCH(int, entries);
  QFETCH(double, threshold);
  const PictureCase& c = translucent();
  RenderCaches caches(caseVolume(c.volume));
  RenderOptions options;
  options.size = size;
  options.step = 1;
  options.stopAt = 0;
  options.precision = 32;
  if (entries) options.curveTable = entries;
  if (threshold > 0) options.opacityThreshold = threshold;
  const Plan plan = *makePlan(c.scene, caches.facts(), options);
  QVERIFY(plan.curve != plan.scene.transferFunction);
  Scene changed = plan.scene;
  changed.transferFunction = plan.curve;
  const Picture expected = bruteForce(changed, *caches.volume(), size, 1);
  const PictureError e = compare(render(plan, caches)->picture, expected);
  // A sample within float rounding of one of the curve's steps may fall on its other side.
  QVERIFY2(e.percentile99 <= 0.02, qPrintable(QStringLiteral("%1").arg(e.percentile99)));
}

void TestKnobs::faintSamplesAreNotTaken() {
  const PictureCase& c = translucent();
  RenderCaches caches(caseVolume(c.volume));
  RenderOptions options;
  const RenderStats all = drawn(c.scene, caches, options).stats;
  options.opacityThreshold = 0.06;
  const RenderStats fewer = drawn(c.scene, caches, options).stats;
  QVERIFY(fewer.composited > 0 && fewer.composited < all.composited);
  options.opacityThreshold = 0;
  QCOMPARE(drawn(c.scene, caches, options).stats.composited, all.composited);
}

void TestKnobs::aSmallerToleranceTakesMorePartsAndErrsLess() {
  const PictureCase& c = translucent();
  RenderCaches caches(caseVolume(c.volume));
  RenderOptions options;
  options.method = Method::reference;
  const Picture truth = drawn(c.scene, caches, options).picture;
  options.method = Method::planes;
  std::int64_t before = 0;
  double errorBefore = std::numeric_limits<double>::infinity();
  // At smaller tolerances, float rounding and the reference have larger errors than the integration rules.
  for (const double tolerance : {1.0, 0.1, 0.01}) {
    options.tolerance = tolerance;
    const Rendered r = drawn(c.scene, caches, options);
    const double error = compare(r.picture, truth).rmse;
    QVERIFY(r.stats.composited > before);
    QVERIFY2(error < errorBefore, qPrintable(QStringLiteral("%1: %2").arg(tolerance).arg(error)));
    before = r.stats.composited;
    errorBefore = error;
  }
}

void TestKnobs::aRayEndsWhereAsked() {
  const PictureCase& c = translucent();
  RenderCaches caches(caseVolume(c.volume));
  Scene scene = c.scene;
  scene.background.transparent = true;
  RenderOptions options;
  options.stopAt = 0;
  const Rendered whole = drawn(scene, caches, options);
  options.stopAt = 0.25;
  const Rendered ended = drawn(scene, caches, options);
  QVERIFY(ended.stats.composited < whole.stats.composited);
  for (std::size_t n = 3; n < whole.picture.rgba.size(); n += 4) {
    const float full = whole.picture.rgba[n], part = ended.picture.rgba[n];
    // Left-out samples lie behind a transmittance of 1/4.
    QVERIFY(part == full || (part >= 0.75f && part < full));
  }
}

// Away from the faces, every operator finds the slope of a ramp exactly.
void TestKnobs::gradientOperatorsAgreeOnARamp() {
  const VolumePtr ramp =
      volumeOf({20, 18, 16}, glm::dmat3(1), [](glm::dvec3 x) { return 8 * x.x + 16 * x.y - 4 * x.z; });
  Scene scene;
  scene.transferFunction.points = {{0, {1, 0.8, 0.6}, 0.01}, {300, {0.4, 0.8, 1}, 0.4}};
  scene.clip.boxLow = glm::dvec3(0.2);
  scene.clip.boxHigh = glm::dvec3(0.8);
  RenderCaches onRamp(ramp), onBumps(caseVolume("bumpy"));
  RenderOptions options;
  const Picture sobelOnRamp = drawn(scene, onRamp, options).picture;
  const Picture sobelOnBumps = drawn(caseNamed("unlit").scene, onBumps, options).picture;
  scene.transferFunction.points[1].value = 700;
  const Picture sobelOnLitBumps = drawn(scene, onBumps, options).picture;
  for (const auto by : {GradientOperator::central, GradientOperator::zuckerHummel}) {
    options.gradient = by;
    QVERIFY(compare(drawn(caseNamed("unlit").scene, onBumps, options).picture, sobelOnBumps).maximum == 0);
    // In a rough volume operators find other directions, and the picture differs.
    QVERIFY(compare(drawn(scene, onBumps, options).picture, sobelOnLitBumps).rmse > 0.1);
    Scene onRampScene = scene;
    onRampScene.transferFunction.points[1].value = 300;
    QVERIFY(compare(drawn(onRampScene, onRamp, options).picture, sobelOnRamp).maximum < 0.01);
  }
}

VOLUMEN_TEST(TestKnobs);
#include "tst_knobs.moc"
