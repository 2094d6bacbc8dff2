// Guards design.md 5, empty blocks: nothing visible is skipped, whatever the block size, which depends on the
// volume's size.
#include <glm/geometric.hpp>
#include <random>

#include "tests/fixtures/cpu_targets.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/methods/caches.h"
#include "viewer/render/render.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Returns specks and a ball in faint noise. The curve shows only the rarest values.
VolumePtr specks(glm::ivec3 size) {
  std::minstd_rand random(11);
  const glm::dvec3 middle = glm::dvec3(size) * 0.4;
  return volumeOf<std::int16_t>(size, glm::dmat3(1), [&](glm::dvec3 p) {
    const double noise = double(random() % 1000) / 10;
    if (glm::length(p - middle) < 0.15 * size.y) return 300 + noise;
    return random() % 997 == 0 ? 400.0 : noise;
  });
}

Scene specksShown(glm::dvec3 direction, double heightMm) {
  Scene scene;
  scene.transferFunction.points = {{150, {1, 1, 1}, 0}, {350, {1, 0.8, 0.6}, 0.3}};
  scene.camera = Camera{};
  scene.camera->direction = direction;
  scene.camera->height = heightMm;
  return scene;
}

}  // namespace

class TestEmptyBlocks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void fullIsTheSamePicture_data();
  void fullIsTheSamePicture();
};

void TestEmptyBlocks::fullIsTheSamePicture_data() {
  QTest::addColumn<glm::ivec3>("size");
  QTest::addColumn<int>("edge");
  QTest::newRow("blocks of one cell") << glm::ivec3(31, 40, 19) << 1;
  QTest::newRow("of two") << glm::ivec3(70, 41, 53) << 2;
  QTest::newRow("of four") << glm::ivec3(61, 90, 55) << 4;
}

void TestEmptyBlocks::fullIsTheSamePicture() {
  QFETCH(glm::ivec3, size);
  QFETCH(int, edge);
  RenderCaches caches(specks(size));
  QCOMPARE(caches.facts().blockRanges->edge, edge);
  const glm::dvec3 directions[] = {{0, 1, 0}, {1, 0, 0}, {0.6, 0.7, -0.4}, {-0.2, -0.9, 0.5}};
  bool skips = false;
  for (const glm::dvec3& direction : directions)
    // Rays of a packet are far apart, some voxels apart, or a part of a voxel apart.
    for (double heightMm : {900.0, 120.0, 9.0})
      for (std::optional<double> step : {std::optional<double>(), {0.2}, {0.4}, {1.0}, {5.0}}) {
        RenderOptions options;
        options.size = {45, 38};
        options.step = step;
        const Scene scene = specksShown(direction, heightMm);
        const auto draw = [&](bool full) {
          options.full = full;
          const Plan plan = *makePlan(scene, caches.facts(), options);
          skips |= plan.skipBlocks;
          return render(plan, caches)->picture;
        };
        const Picture whole = draw(true);
        onEveryCpuTarget([&] {
          QVERIFY2(draw(false) == whole, qPrintable(QStringLiteral("%1: %2 mm, step %3, towards %4")
                                                        .arg(QString::fromLatin1(kernelTarget()))
                                                        .arg(heightMm)
                                                        .arg(step.value_or(0))
                                                        .arg(direction.x)));
        });
      }
  QVERIFY(skips);
}

VOLUMEN_TEST(TestEmptyBlocks);
#include "tst_empty_blocks.moc"
