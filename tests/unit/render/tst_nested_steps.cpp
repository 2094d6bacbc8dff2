// Guards the kernel of nested steps (Sampling::nested): plain steps whose picture is the same as without it,
// the change from steps of twice the length, and the rays that are redone for it.
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr double nestedStep = 0.5;

// Returns a scene in which most rays show something and few become opaque early.
Scene softNoise() {
  Scene scene;
  scene.transferFunction.points = {{150, {1, 0.4, 0.2}, 0}, {900, {0.4, 0.8, 1}, 0.6}};
  scene.transferFunction.unitDistance = 1;
  Camera camera;
  camera.direction = {0.3, 0.5, 0.8};
  camera.up = {0.1, 1, 0.2};
  camera.height = 30;
  scene.camera = camera;
  return scene;
}

// Returns a picture of plain steps as if a pilot had accepted them.
Rendered nestedPicture(const Scene& scene, RenderCaches& caches, double redoneAbove) {
  RenderOptions options;
  options.size = {40, 36};
  options.stopAt = 1e-3;  // levels and plain steps end rays differently
  PilotFinding kept{nestedStep, true};
  kept.redoneAbove = redoneAbove;
  kept.errorScale = 1;
  return *render(*makePlan(scene, caches.facts(), options, kept), caches);
}

Rendered drawnAt(const Scene& scene, RenderCaches& caches, std::optional<double> plainStep) {
  RenderOptions options;
  options.size = {40, 36};
  options.stopAt = 1e-3;  // levels and plain steps end rays differently
  options.step = plainStep;
  return *render(*makePlan(scene, caches.facts(), options), caches);
}

using NestedChange = void (*)(Scene&);

}  // namespace

Q_DECLARE_METATYPE(NestedChange)

class TestNestedSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void raysAreThoseOfPlainStepsOrRedone_data();
  void raysAreThoseOfPlainStepsOrRedone();
  void theErrorIsThatOfEveryOtherStep();
};

void TestNestedSteps::raysAreThoseOfPlainStepsOrRedone_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<NestedChange>("change");
  const VolumePtr whole = randomVolume<std::int16_t>({24, 20, 22}, -200, 1000);
  const VolumePtr floats = randomVolume<float>({24, 20, 22}, -200, 1000);
  const auto row = [&](const char* name, NestedChange change) {
    QTest::addRow("%s, integers", name) << whole << change;
    QTest::addRow("%s, floats", name) << floats << change;
  };
  row("lit", [](Scene&) {});
  row("unlit", [](Scene& s) { s.shading.lit = false; });
  row("gradient opacity", [](Scene& s) { s.transferFunction.gradientOpacity = {{0, 0.2}, {300, 1}}; });
  row("one side, local viewer, in perspective", [](Scene& s) {
    s.shading.sides = 1;
    s.shading.localViewer = true;
    s.camera->projection = Projection::perspective;
    s.camera->distance = 60;
  });
  row("clipped, over nothing", [](Scene& s) {
    s.clip.boxHigh = {0.7, 0.6, 1};
    s.background.transparent = true;
  });
}

void TestNestedSteps::raysAreThoseOfPlainStepsOrRedone() {
  QFETCH(VolumePtr, volume);
  QFETCH(NestedChange, change);
  Scene scene = softNoise();
  change(scene);
  RenderCaches caches(volume);
  const Rendered plain = drawnAt(scene, caches, nestedStep), cells = drawnAt(scene, caches, {}),
                 all = nestedPicture(scene, caches, 1000);
  QVERIFY(cells.plan.cellByCell);
  QVERIFY(all.picture == plain.picture);
  QCOMPARE(all.stats.redone, 0);
  constexpr double limit = 4;  // of 255
  const Rendered some = nestedPicture(scene, caches, limit / 255);
  std::int64_t redone = 0;
  for (std::size_t n = 0; n < all.error.size(); ++n) {
    const bool isRedone = all.error[n] > PilotFinding::leastChange + limit;
    redone += isRedone;
    // Rays beside it decide where a ray is cut into groups of steps, each integrated for itself.
    const double near = isRedone ? 2.0 / 255 : 0;
    const Picture& right = isRedone ? cells.picture : plain.picture;
    for (std::size_t c = 4 * n; c < 4 * n + 4; ++c)
      QVERIFY(std::abs(double(some.picture.rgba[c]) - double(right.rgba[c])) <= near);
    if (!isRedone)
      QCOMPARE(some.error[n], all.error[n]);
    else
      QVERIFY(some.error[n] > 0 && some.error[n] <= 8);
  }
  QCOMPARE(some.stats.redone, redone);
  QVERIFY2(redone > 30 && redone < std::int64_t(all.error.size()) - 30, qPrintable(QString::number(redone)));
}

// Along z, values of plates are known between voxels; steps of every other sample are twice as long.
void TestNestedSteps::theErrorIsThatOfEveryOtherStep() {
  constexpr int voxels = 16;
  const auto valueAt = [](int k) { return k * 37 % 11 * 90.0; };
  const VolumePtr plates =
      volumeOf<std::int16_t>({8, 8, voxels}, glm::dmat3(1), [&](glm::dvec3 p) { return valueAt(int(p.z)); });
  Scene scene = softNoise();
  for (CurvePoint& p : scene.transferFunction.points) p.colour = {1, 1, 1};
  scene.transferFunction.points[1].opacity = 0.3;
  scene.shading.lit = false;
  scene.camera->direction = {0, 0, 1};
  scene.camera->up = {0, 1, 0};
  scene.camera->height = 4;
  double fine = 0, coarse = 0;
  for (int n = 0; n < voxels / nestedStep; ++n) {
    const double z = std::clamp((n + 0.5) * nestedStep - 0.5, 0.0, voxels - 1.0);
    const int k = std::min(int(z), voxels - 2);
    const double value = valueAt(k) + (z - k) * (valueAt(k + 1) - valueAt(k));
    const double opacity = 0.3 * std::clamp((value - 150) / 750, 0.0, 1.0);
    fine += (1 - fine) * (1 - std::pow(1 - opacity, nestedStep));
    if (n % 2 == 0) coarse += (1 - coarse) * (1 - std::pow(1 - opacity, 2 * nestedStep));
  }
  RenderCaches caches(plates);
  const Rendered done = nestedPicture(scene, caches, 1000);
  constexpr double roundingOf255 = 0.05;  // of positions, in every error
  const double expected = PilotFinding::leastChange + 255 * std::abs(fine - coarse) + roundingOf255;
  QVERIFY(255 * std::abs(fine - coarse) > 1);
  for (const float error : done.error)
    QVERIFY2(std::abs(error - expected) < 0.01, qPrintable(QStringLiteral("%1 %2").arg(error).arg(expected)));
}

VOLUMEN_TEST(TestNestedSteps);
#include "tst_nested_steps.moc"
