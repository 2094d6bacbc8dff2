// Guards design.md 2 and 5: if the planner replaces integration cell by cell by plain steps, levels keep
// their promises. Covers the volumes that change most between two samples.
#include <cstdio>
#include <random>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_parts.h"
#include "tests/unit/suite.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

constexpr int edge = 32;

VolumePtr layers(bool (*isBright)(int k), int depth = edge) {
  VolumeParts parts;
  parts.geometry.size = {edge, edge, depth};
  std::vector<std::int16_t> values(std::size_t(edge * edge * depth));
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = isBright(int(n / (edge * edge))) ? 1000 : 0;
  parts.values = std::move(values);
  return volumeFrom(std::move(parts));
}

VolumePtr binaryNoise() {
  std::mt19937 random(3);
  return volumeOf({edge, edge, edge}, glm::dmat3(1), [&](glm::dvec3) { return random() % 2 * 1000.0; });
}

enum class Lit { not_, softly, strongly, byMap };

// Opacity rises over all values. `phase` is the position of the first sample in eighths of a voxel.
Scene sceneOf(double opacity, Lit lit, glm::dvec3 direction, int phase, int depth) {
  Scene scene;
  scene.transferFunction.points = {{0, {1, 1, 1}, 0}, {1000, {1, 1, 1}, opacity}};
  scene.transferFunction.unitDistance = 1;
  scene.shading.lit = lit != Lit::not_;
  if (lit == Lit::strongly) {
    scene.shading.diffuse = scene.shading.specular = 1;
    scene.shading.shininess = 50;
    scene.shading.gradientFloor = 0.01;
  }
  Camera camera;
  camera.direction = direction;
  camera.up = {0.1, 1, 0.2};
  camera.height = 30;
  scene.camera = camera;
  scene.clip.boxLow.z = (0.02 + phase / 8.0) / depth;
  return scene;
}

}  // namespace

Q_DECLARE_METATYPE(Lit)

class TestEvenSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyKeepTheLevelsPromises_data();
  void theyKeepTheLevelsPromises();
  void noDirectionResonates();
};

void TestEvenSteps::theyKeepTheLevelsPromises_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<Lit>("lit");
  const auto noiseOf = [](const glm::dmat3& patientFromVoxelStep) {
    std::mt19937 random(5);
    return volumeOf({edge, edge, edge}, patientFromVoxelStep, [&](glm::dvec3) { return random() % 1001; });
  };
  const std::pair<const char*, VolumePtr> volumes[] = {
      {"noise of long voxels", noiseOf({1, 0, 0, 0, 1, 0, 0, 0, 3})},
      {"noise of sheared voxels", noiseOf({1, 0, 0, 0.2, 1, 0, 0, 0.5, 1})},
      {"noise", randomVolume<std::int16_t>({edge, edge, edge}, 0, 1001)},
      {"noise of two values", binaryNoise()},
      {"plate of one voxel", layers([](int k) { return k == edge / 2; })},
      {"plate of two voxels", layers([](int k) { return k / 2 == edge / 4; })},
      {"stripes of one voxel", layers([](int k) { return k % 2 == 0; })},
      {"256 stripes of one voxel", layers([](int k) { return k % 2 == 0; }, 512)}};
  for (const auto& [name, volume] : volumes) {
    QTest::addRow("%s, unlit", name) << volume << Lit::not_;
    QTest::addRow("%s, lit", name) << volume << Lit::softly;
    QTest::addRow("%s, strong highlight", name) << volume << Lit::strongly;
    QTest::addRow("%s, by a reflectance map", name) << volume << Lit::byMap;
  }
}

void TestEvenSteps::theyKeepTheLevelsPromises() {
  QFETCH(VolumePtr, volume);
  QFETCH(Lit, lit);
  RenderCaches caches(volume);
  QStringList broken;
  int even = 0;
  for (double opacity : {0.005, 0.02, 0.04, 0.12})
    for (const glm::dvec3& direction :
         {glm::dvec3(0, 0, 1), glm::dvec3(0.3, 0.5, 0.8), glm::dvec3(0.6, 0, 0.8)})
      for (int phase : {0, 1, 2, 4}) {
        Scene scene = sceneOf(opacity, lit, direction, phase, volume->size().z);
        if (phase == 2) {
          scene.camera->projection = Projection::perspective;
          scene.camera->fov = 60;
          scene.camera->distance = 60;
        }
        Truth truth(caches, scene, {16, 16});
        for (const Promise& promise : promises) {
          RenderOptions options = atLevel(promise.quality);
          if (lit == Lit::byMap) options.shader = Shader::map;
          options.size = {16, 16};
          if (makePlan(scene, caches.facts(), options)->cellByCell) continue;
          ++even;
          const PictureError e = truth.errorOf(truth.drawn(options), promise);
          if (!promise.keptBy(e))
            broken << QStringLiteral("opacity %1, phase %2, %3: %4")
                          .arg(opacity)
                          .arg(phase)
                          .arg(QString::fromLatin1(promise.name), inWords(e));
        }
      }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QStringLiteral("; "))));
  QVERIFY2(even >= 8, "hardly any scene takes plain steps: this row proves nothing");
}

// Views VOLUMEN_RANDOM_CASES=N lattices along directions of small integers.
void TestEvenSteps::noDirectionResonates() {
  const Seeds seeds = seedsOf(50, 150);
  QStringList broken;
  int even = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const RandomCase c = randomLattice(chance);
    RenderCaches caches(c.volume);
    Truth truth(caches, c.scene, c.size);
    for (const Promise& promise : promises) {
      RenderOptions options = atLevel(promise.quality);
      options.size = c.size;
      const auto plan = makePlan(c.scene, caches.facts(), options);
      if (plan->cellByCell) continue;
      ++even;
      const PictureError e = truth.errorOf(truth.drawn(options), promise);
      const QString words = QStringLiteral("seed %1, %2, step %3: %4")
                                .arg(seed)
                                .arg(QLatin1String(promise.name))
                                .arg(plan->stepVoxels)
                                .arg(inWords(e));
      if (figuresWanted()) std::fprintf(stderr, "%s\n", qPrintable(words));
      if (!promise.keptBy(e)) broken << words;
    }
  }
  QVERIFY2(broken.isEmpty(), qPrintable(broken.join(QLatin1Char('\n'))));
  QVERIFY2(even >= seeds.count / 4, "hardly any scene takes plain steps: this proves nothing");
}

VOLUMEN_TEST(TestEvenSteps);
#include "tst_even_steps.moc"
