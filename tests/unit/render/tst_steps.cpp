// Guards picture.md 9, design.md 2 (step, standard, determinism) and design.md 5 (full) on every picture
// case.
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <stdexcept>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/cpu_targets.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/picture_words.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/render/picture_cases.h"
#include "tests/unit/render/random_scenes.h"
#include "tests/unit/suite.h"
#include "viewer/reference/reference.h"
#include "viewer/render/render.h"
#include "viewer/scene/presets.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// In the translucent chest all samples count, so that its picture is smaller to keep the test short.
glm::ivec2 sizeOf(const PictureCase& c) {
  return std::string(c.name).ends_with("gel") ? glm::ivec2(32) : glm::ivec2(64);
}

const Picture& referenceOf(const PictureCase& c) {
  static std::map<std::string, Picture> pictures;
  const auto [entry, isNew] = pictures.try_emplace(c.name);
  if (isNew) {
    const VolumePtr volume = caseVolume(c.volume);
    entry->second = *renderReference(completed(c.scene, *volume, sizeOf(c)), *volume, sizeOf(c));
  }
  return entry->second;
}

/// Draws a case. Gradients and tables of its volume are made once.
Picture drawn(const PictureCase& c, RenderOptions options) {
  static std::map<std::string, RenderCaches> caches;
  RenderCaches& cache = caches.try_emplace(c.volume, caseVolume(c.volume)).first->second;
  options.size = sizeOf(c);
  const Result<Plan> plan = makePlan(c.scene, cache.facts(), options);
  if (!plan) throw std::runtime_error(plan.message());
  const Result<Rendered> rendered = render(*plan, cache);
  if (!rendered) throw std::runtime_error(rendered.message());
  return rendered->picture;
}

}  // namespace

Q_DECLARE_METATYPE(Camera)

class TestSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void plansCompleteTheScene_data() { addCaseRows(); }
  void plansCompleteTheScene();
  void aStepIsAsGoodAsTheMidpointRule_data() { addCaseRows(); }
  void aStepIsAsGoodAsTheMidpointRule();
  void standardKeepsItsPromise_data() { addCaseRows(); }
  void standardKeepsItsPromise();
  void threadsChangeNoByte_data() { addCaseRows(); }
  void threadsChangeNoByte();
  void fullIsTheSamePicture_data() { addCaseRows(); }
  void fullIsTheSamePicture();
  void fullIsTheSamePictureOfThinNoise_data();
  void fullIsTheSamePictureOfThinNoise();
  void scenesOfChanceAreFiniteAndTheSameEveryWay();

 private:
  static void addCaseRows() {
    QTest::addColumn<int>("index");
    for (std::size_t i = 0; i < pictureCases().size(); ++i) QTest::newRow(pictureCases()[i].name) << int(i);
  }
};

#define NEED_CASE(c)                            \
  QFETCH(int, index);                           \
  const PictureCase& c = pictureCases()[index]; \
  NEED_VOLUME(caseVolume(c.volume))

void TestSteps::plansCompleteTheScene() {
  NEED_CASE(c);
  const VolumePtr volume = caseVolume(c.volume);
  RenderOptions options;
  options.size = {120, 80};
  const Result<Plan> plan = makePlan(c.scene, factsOf(*volume), options);
  QVERIFY2(plan.ok(), plan.ok() ? "" : plan.message().c_str());
  const Scene expected = completed(c.scene, *volume, options.size);
  const Scene& scene = plan->scene;
  QVERIFY(scene.camera && scene.camera->target && scene.window && scene.shading.gradientFloor);
  QVERIFY(glm::length(*scene.camera->target - *expected.camera->target) <=
          1e-9 * (1 + glm::length(*expected.camera->target)));
  QCOMPARE(scene.camera->height, expected.camera->height);
  QCOMPARE(scene.camera->direction, expected.camera->direction);
  QCOMPARE(scene.window->centre, expected.window->centre);
  QCOMPARE(scene.window->width, expected.window->width);
  QCOMPARE(*scene.shading.gradientFloor, *expected.shading.gradientFloor);
}

// design.md 2: errors are at most those of the midpoint rule in double precision, plus two terms. Stored
// precision adds 5 % (the same samples, rounded). Samples behind a transmittance of 1/4096 add 0.06/255.
void TestSteps::aStepIsAsGoodAsTheMidpointRule() {
  NEED_CASE(c);
  for (double step : {1.0, 0.5}) {
    const PictureError rule =
        compare(bruteForce(c.scene, *caseVolume(c.volume), sizeOf(c), step), referenceOf(c));
    for (int bits : {16, 32}) {
      RenderOptions options;
      options.step = step;
      options.precision = bits;
      const PictureError e = compare(drawn(c, options), referenceOf(c));
      QVERIFY2(e.rmse <= 1.05 * rule.rmse + 0.01 && e.percentile99 <= 1.05 * rule.percentile99 + 0.06,
               qPrintable(QStringLiteral("step %1, %2 bits: %3; the rule: %4")
                              .arg(step)
                              .arg(bits)
                              .arg(inWords(e), inWords(rule))));
    }
  }
}

void TestSteps::standardKeepsItsPromise() {
  NEED_CASE(c);
  const Picture picture = drawn(c, {});
  const LevelPromise& promised = promiseOf(Quality::standard);
  const auto kept = [&](const PictureError& e) {
    return e.psnrDb >= promised.leastPsnrDb && e.percentile99 <= promised.most99;
  };
  PictureError e = compare(picture, referenceOf(c));
  if (!kept(e)) {  // promised on well-conditioned pixels only
    const VolumePtr volume = caseVolume(c.volume);
    const auto use = *wellConditioned(completed(c.scene, *volume, sizeOf(c)), *volume, sizeOf(c));
    e = compare(picture, referenceOf(c), use);
  }
  QVERIFY2(kept(e), qPrintable(inWords(e)));
}

void TestSteps::threadsChangeNoByte() {
  NEED_CASE(c);
  RenderOptions options;
  options.threads = 1;
  const Picture one = drawn(c, options);
  for (int threads : {2, 7, 16}) {
    options.threads = threads;
    QVERIFY2(drawn(c, options) == one, qPrintable(QStringLiteral("%1 threads").arg(threads)));
  }
}

void TestSteps::fullIsTheSamePicture() {
  NEED_CASE(c);
  RenderOptions options;
  options.full = true;
  QVERIFY(drawn(c, options) == drawn(c, {}));
  options.step = 1;
  RenderOptions plain;
  plain.step = 1;
  QVERIFY(drawn(c, options) == drawn(c, plain));
}

// Rays are oblique and pass noise at the edge of the curve. Where they begin to step must not matter.
void TestSteps::fullIsTheSamePictureOfThinNoise_data() {
  QTest::addColumn<Camera>("camera");
  const auto row = [](const char* name, glm::dvec3 direction, Projection projection) {
    Camera camera;
    camera.direction = direction;
    camera.projection = projection;
    QTest::newRow(name) << camera;
  };
  row("askew", {0.5, 0.8, -0.33}, Projection::parallel);
  row("from a corner, through three faces", {0.69, -0.62, -0.37}, Projection::parallel);
  row("grazing the slices", {1, 0.03, -0.02}, Projection::parallel);
  row("perspective", {-0.4, 0.9, 0.3}, Projection::perspective);
}

// Which thin and faint cells are visited depends on skipping and on the rays of a vector. The sum must not.
void TestSteps::fullIsTheSamePictureOfThinNoise() {
  const VolumePtr chest = caseVolume("ct-chest-lidc0314-138");
  NEED_VOLUME(chest);
  QFETCH(Camera, camera);
  Scene scene = *presetScene("CT-Bones", *chest);
  scene.camera = camera;
  RenderCaches caches(chest);
  RenderOptions options;
  options.size = {431, 405};
  std::optional<Picture> first;
  QStringList others;
  onEveryCpuTarget([&] {
    const auto draw = [&](bool full) {
      options.full = full;
      const Picture picture = render(*makePlan(scene, caches.facts(), options), caches)->picture;
      if (!first) first = picture;
      if (picture != *first)
        others << QString::fromLatin1(kernelTarget()) + (full ? QStringLiteral(" in full") : QString());
    };
    draw(false);
    draw(true);
  });
  QVERIFY2(others.isEmpty(), qPrintable(others.join(QStringLiteral(", "))));
}

void TestSteps::scenesOfChanceAreFiniteAndTheSameEveryWay() {
  const Seeds seeds = seedsOf(170, 500);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const RandomScene c = randomScene(std::uint64_t(seed));
    RenderCaches caches(c.volume);
    RenderOptions options;
    options.size = c.size;
    const auto draw = [&] { return *render(*makePlan(c.scene, caches.facts(), options), caches); };
    const Picture picture = draw().picture;
    for (float component : picture.rgba)
      QVERIFY2(component >= 0 && component <= 1, qPrintable(QStringLiteral("seed %1").arg(seed)));
    options.threads = 3;
    QVERIFY2(draw().picture == picture, qPrintable(QStringLiteral("seed %1, threads").arg(seed)));
    options.full = true;
    QVERIFY2(draw().picture == picture, qPrintable(QStringLiteral("seed %1, full").arg(seed)));
  }
}

VOLUMEN_TEST(TestSteps);
#include "tst_steps.moc"
