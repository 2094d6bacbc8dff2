// Guards picture.md 2 to 8 and design.md 2 (the reference): two independently written renderers agree.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/brute_matter.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/picture_words.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/render/picture_cases.h"
#include "tests/unit/render/random_scenes.h"
#include "tests/unit/suite.h"
#include "viewer/reference/reference.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

void addCaseRows() {
  QTest::addColumn<int>("index");
  for (std::size_t i = 0; i < pictureCases().size(); ++i) QTest::newRow(pictureCases()[i].name) << int(i);
}

}  // namespace

class TestBruteForce : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void halfTheStepChangesLittle_data() { addCaseRows(); }
  void halfTheStepChangesLittle();
  void referenceAgrees_data() { addCaseRows(); }
  void referenceAgrees();
  void referenceAgreesOnScenesOfChance();
  void wellConditionedIsWhatMovesLittle_data();
  void wellConditionedIsWhatMovesLittle();
};

// The error falls with the square of the step. Errors at the step used below (1/64 voxel) are a third of
// these bounds: RMSE 0.007/255, maximum 0.07/255.
void TestBruteForce::halfTheStepChangesLittle() {
  QFETCH(int, index);
  const PictureCase& c = pictureCases()[index];
  const VolumePtr volume = caseVolume(c.volume);
  NEED_VOLUME(volume);
  const Scene scene = completed(c.scene, *volume, {20, 20});
  const PictureError e = compare(bruteForceLimit(scene, *volume, {20, 20}, 1.0 / 32),
                                 bruteForceLimit(scene, *volume, {20, 20}, 1.0 / 64));
  QVERIFY2(e.rmse <= 0.02 && e.maximum <= 0.2, qPrintable(inWords(e)));
}

// The reference promises 0.05/255 (design.md 2), and brute force is within 0.07/255 (above).
void TestBruteForce::referenceAgrees() {
  QFETCH(int, index);
  const PictureCase& c = pictureCases()[index];
  const VolumePtr volume = caseVolume(c.volume);
  NEED_VOLUME(volume);
  const glm::ivec2 size(24, 20);
  const Scene scene = completed(c.scene, *volume, size);
  const Result<Picture> reference = renderReference(scene, *volume, size);
  QVERIFY2(reference.ok(), reference.ok() ? "" : reference.message().c_str());
  const Result<std::vector<std::uint8_t>> use = wellConditioned(scene, *volume, size);
  QVERIFY(use.ok());
  // The mask may exclude only few pixels, else the comparison proves nothing.
  QVERIFY(std::count(use->begin(), use->end(), 1) >= 0.97 * size.x * size.y);
  const PictureError e = compare(*reference, bruteForceLimit(scene, *volume, size), *use);
  QVERIFY2(e.rmse <= 0.01 && e.maximum <= 0.12, qPrintable(inWords(e)));
}

// In tiny pictures of extreme scenes brute force has larger errors of its own. It takes fine steps, and finer
// ones after a difference.
void TestBruteForce::referenceAgreesOnScenesOfChance() {
  const Seeds seeds = seedsOf(500, 1500);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const RandomScene c = randomScene(std::uint64_t(seed));
    const Scene scene = completed(c.scene, *c.volume, c.size);
    const Result<Picture> reference = renderReference(scene, *c.volume, c.size, 1);
    const Result<std::vector<std::uint8_t>> use = wellConditioned(scene, *c.volume, c.size, 1);
    QVERIFY(reference.ok() && use.ok());
    PictureError e;
    for (int steps = 64; steps == 64 || (e.maximum > 0.12 && steps <= 16384); steps *= 16)
      e = compare(*reference, bruteForceLimit(scene, *c.volume, c.size, 1.0 / steps), *use);
    QVERIFY2(e.maximum <= 0.12, qPrintable(QStringLiteral("seed %1: ").arg(seed) + inWords(e)));
  }
}

void TestBruteForce::wellConditionedIsWhatMovesLittle_data() {
  QTest::addColumn<int>("index");
  for (std::size_t i = 0; i < pictureCases().size(); ++i)
    for (const char* name : {"isotropic grid, eye inside", "left-handed grid, eye inside"})
      if (pictureCases()[i].name == std::string(name)) QTest::newRow(name) << int(i);
}

// Moving the camera's target moves every ray, here by 1e-4 voxel in the picture's four directions.
void TestBruteForce::wellConditionedIsWhatMovesLittle() {
  QFETCH(int, index);
  const PictureCase& c = pictureCases()[index];
  const VolumePtr volume = caseVolume(c.volume);
  const glm::ivec2 size(60, 60);
  const Scene scene = completed(c.scene, *volume, size);
  const Picture still = *renderReference(scene, *volume, size);
  const std::vector<std::uint8_t> use = *wellConditioned(scene, *volume, size);
  std::vector<double> change(use.size());
  for (int side = 0; side < 4; ++side) {
    const glm::dvec3 axis = axesOf(*scene.camera)[side / 2];
    Scene moved = scene;
    *moved.camera->target +=
        (side % 2 ? 1e-4 : -1e-4) * axis / glm::length(volume->geometry().voxelFromPatientStep() * axis);
    const Picture picture = *renderReference(moved, *volume, size);
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
      change[i / 4] = std::max(change[i / 4], 255.0 * std::abs(picture.rgba[i] - still.rgba[i]));
  }
  QVERIFY(*std::max_element(change.begin(), change.end()) > 0.1);
  for (std::size_t i = 0; i < use.size(); ++i)
    if (std::abs(change[i] - 0.1) > 1e-3) QCOMPARE(bool(use[i]), change[i] <= 0.1);
}

VOLUMEN_TEST(TestBruteForce);
#include "tst_brute_force.moc"
