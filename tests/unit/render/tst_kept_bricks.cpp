// Guards design.md 5: gradients that are kept of what is visible alone make the same picture, of which the
// same is counted, and take less.
#include <glm/geometric.hpp>
#include <random>

#include "tests/fixtures/cpu_targets.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/methods/caches.h"
#include "viewer/methods/kept_bricks.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Two balls in faint noise around 0, which the curves here hide.
template <class T>
VolumePtr balls(glm::ivec3 size) {
  std::minstd_rand random(5);
  return volumeOf<T>(size, glm::dmat3(1), [&](glm::dvec3 p) {
    const double noise = double(random() % 1000) / 10;
    const bool isIn = glm::length(p - glm::dvec3(size) * 0.3) < 0.12 * size.y ||
                      glm::length(p - glm::dvec3(size) * 0.8) < 0.07 * size.y;
    return isIn ? 300 + noise : noise;
  });
}

Scene ballsShown(glm::dvec3 direction, double heightMm) {
  Scene scene;
  scene.transferFunction.points = {{150, {1, 1, 1}, 0}, {350, {1, 0.8, 0.6}, 0.3}};
  scene.camera = Camera{};
  scene.camera->direction = direction;
  scene.camera->height = heightMm;
  return scene;
}

std::shared_ptr<StoredVoxels> sparing(const VolumePtr& volume) {
  auto voxels = std::make_shared<StoredVoxels>(volume);
  voxels->spareGradients(true);
  return voxels;
}

}  // namespace

class TestKeptBricks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesAreTheSame_data();
  void picturesAreTheSame();
  void whatIsReadInRowsIsKeptWhole_data();
  void whatIsReadInRowsIsKeptWhole();
  void otherCurvesGetTheirs();
};

void TestKeptBricks::picturesAreTheSame_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<Method>("method");
  QTest::newRow("int16") << balls<std::int16_t>({61, 90, 55}) << Method::planes;
  QTest::newRow("uint16, sizes a voxel beyond bricks")
      << balls<std::uint16_t>({57, 89, 65}) << Method::planes;
  QTest::newRow("blocks of two") << balls<std::int16_t>({70, 41, 53}) << Method::planes;
  QTest::newRow("blended") << balls<std::int16_t>({61, 90, 55}) << Method::blend;
}

void TestKeptBricks::picturesAreTheSame() {
  QFETCH(VolumePtr, volume);
  QFETCH(Method, method);
  RenderCaches all(volume), some(sparing(volume));
  for (const glm::dvec3& direction :
       {glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0.7, -0.4), glm::dvec3(-0.2, -0.9, 0.5)})
    for (double heightMm : {900.0, 120.0, 9.0})
      for (std::optional<double> step : {std::optional<double>(), {0.4}, {1.0}, {5.0}}) {
        RenderOptions options;
        options.size = {45, 38};
        options.step = step;
        options.method = method;
        Scene scene = ballsShown(direction, heightMm);
        if (step == 1.0) scene.transferFunction.gradientOpacity = {{0, 0}, {100, 1}};
        const Plan plan = *makePlan(scene, all.facts(), options);
        onEveryCpuTarget([&] {
          const auto expected = render(plan, all), is = render(plan, some);
          const auto told = QStringLiteral("%1: %2 mm, step %3, towards %4")
                                .arg(QString::fromLatin1(kernelTarget()))
                                .arg(heightMm)
                                .arg(step.value_or(0))
                                .arg(direction.x);
          QVERIFY2(is->picture == expected->picture && is->error == expected->error, qPrintable(told));
          QVERIFY2(is->stats.shaded == expected->stats.shaded &&
                       is->stats.composited == expected->stats.composited,
                   qPrintable(told));
          QVERIFY2(is->stats.gradientBytes < expected->stats.gradientBytes * 3 / 4, qPrintable(told));
        });
      }
}

void TestKeptBricks::whatIsReadInRowsIsKeptWhole_data() {
  QTest::addColumn<RenderOptions>("options");
  const auto row = [](const char* name, const std::function<void(RenderOptions&)>& set) {
    RenderOptions options;
    options.size = {45, 38};
    set(options);
    QTest::newRow(name) << options;
  };
  row("every block is looked at", [](RenderOptions& o) { o.full = true; });
  row("shaded first", [](RenderOptions& o) { o.method = Method::preshaded, o.step = 1.0; });
  row("another operator", [](RenderOptions& o) { o.gradient = GradientOperator::central, o.step = 1.0; });
  row("floats", [](RenderOptions& o) { o.precision = 32, o.step = 1.0; });
  row("bytes", [](RenderOptions& o) { o.precision = 8, o.step = 1.0; });
}

void TestKeptBricks::whatIsReadInRowsIsKeptWhole() {
  QFETCH(RenderOptions, options);
  const VolumePtr volume = balls<std::int16_t>({61, 90, 55});
  RenderCaches all(volume), some(sparing(volume));
  const auto plan = makePlan(ballsShown({0.6, 0.7, -0.4}, 120), all.facts(), options);
  QVERIFY2(plan, plan ? "" : plan.message().c_str());
  const auto expected = render(*plan, all), is = render(*plan, some);
  QVERIFY(is->picture == expected->picture);
  QCOMPARE(is->stats.gradientBytes, expected->stats.gradientBytes);
}

void TestKeptBricks::otherCurvesGetTheirs() {
  const VolumePtr volume = balls<std::int16_t>({61, 90, 55});
  const auto voxels = sparing(volume);
  RenderCaches all(volume), some(voxels);
  RenderOptions options;
  options.size = {45, 38};
  const auto draw = [&](float from, RenderCaches& caches) {
    Scene scene = ballsShown({0.6, 0.7, -0.4}, 120);
    scene.transferFunction.points = {{from, {1, 1, 1}, 0}, {from + 5, {1, 0.8, 0.6}, 0.3}};
    return *render(*makePlan(scene, all.facts(), options), caches);
  };
  const auto bytes = [&](float from) { return draw(from, some).stats.gradientBytes; };
  const std::size_t few = bytes(350);
  QVERIFY(draw(350, some).picture == draw(350, all).picture);
  // Noise shows in more places, in none that were kept, then in all.
  QVERIFY(draw(98.5f, some).picture == draw(98.5f, all).picture);
  QVERIFY(bytes(98.5f) > few);
  QVERIFY(draw(350, some).picture == draw(350, all).picture);
  QVERIFY(draw(10, some).picture == draw(10, all).picture);
  QCOMPARE(bytes(10), draw(10, all).stats.gradientBytes);
  QVERIFY2(!voxels->sparesGradients(), "all are there now");
}

VOLUMEN_TEST(TestKeptBricks);
#include "tst_kept_bricks.moc"
