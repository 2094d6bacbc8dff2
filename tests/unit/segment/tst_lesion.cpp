// Guards lesion.h: the component about the largest value of a region, against a flood fill, and spheres in
// closed form. Leaks and regions without a value are refused.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/lesion.h"

using namespace volumen;
using namespace volumen::tests;

class TestLesion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void asByAFlood();
  void aConeIsABallOfItsShare_data();
  void aConeIsABallOfItsShare();
  void refusedInOneSentence_data();
  void refusedInOneSentence();
  void theEndOfTheGridIsNoLeak();
};

namespace {

constexpr glm::ivec3 coneMiddle(15);

// Returns a cone of 10 in the middle of 31^3 voxels that reaches 0 at 12 mm.
VolumePtr coneVolume() {
  return volumeOf<float>({31, 31, 31}, glm::dmat3(1), [](glm::dvec3 v) {
    return 10 * std::max(0.0, 1 - glm::distance(v, glm::dvec3(coneMiddle)) / 12);
  });
}

BitMask voxelBall(const VoxelGeometry& grid, glm::dvec3 at, double radius) {
  BitMask ball(grid);
  for (const glm::ivec3 v : voxelsOf(grid)) ball.set(v, glm::distance(glm::dvec3(v), at) <= radius);
  return ball;
}

// Finds the lesion voxel by voxel; empty if it is refused.
std::optional<BitMask> lesionSlowly(const BitMask& region, const Volume& volume, LesionThreshold threshold) {
  double most = -std::numeric_limits<double>::infinity();
  std::optional<glm::ivec3> at;
  for (const glm::ivec3 v : voxelsOf(region.geometry()))
    if (const double value = double(volume.value(v.x, v.y, v.z)); region.at(v) && value > most)
      most = value, at = v;
  const double least = threshold.isShare ? threshold.amount * most : threshold.amount;
  if (!at || most < least) return {};
  BitMask there(region.geometry());
  for (const glm::ivec3 v : voxelsOf(region.geometry()))
    there.set(v, region.at(v) && double(volume.value(v.x, v.y, v.z)) >= least);
  BitMask found = reachedFrom({*at}, there, stepsAcross(-1));
  for (const glm::ivec3 v : voxelsOf(region.geometry()))
    for (const glm::ivec3 step : stepsAcross(-1))
      if (found.at(v) && isInGrid(v + step, region.size()) && !region.at(v + step)) return {};
  return found;
}

}  // namespace

void TestLesion::asByAFlood() {
  const Seeds seeds = seedsOf(300, 10000);
  int refused = 0, found = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {24, 9, 7});
    const int kinds = 2 + int(random() % 9);
    const VolumePtr volume = volumeOf<std::int16_t>(grid.size, grid.patientFromVoxelStep,
                                                    [&](glm::dvec3) { return int(random()) % kinds; });
    const BitMask region = anyMask(random, grid);
    const LesionThreshold threshold{random() % 2 ? double(random() % 100) / 100 : double(random() % 9),
                                    random() % 2 == 0};
    BitMask onGrid(volume->geometry());
    std::ranges::copy(region.words(), onGrid.words().begin());
    const auto expected = lesionSlowly(onGrid, *volume, threshold);
    const auto made = lesionIn(onGrid, *volume, threshold);
    QVERIFY2(bool(made) == expected.has_value(), caseOf(seed, region).c_str());
    if (expected) QVERIFY2(*made == *expected, caseOf(seed, region).c_str());
    ++(expected ? found : refused);
  }
  QVERIFY2(found > seeds.count / 20 && refused > seeds.count / 20, "both are tried");
}

void TestLesion::aConeIsABallOfItsShare_data() {
  QTest::addColumn<double>("amount");
  QTest::addColumn<bool>("isShare");
  QTest::addColumn<double>("radius");
  QTest::newRow("41 %") << 0.41 << true << 12 * 0.59;
  QTest::newRow("50 %") << 0.5 << true << 6.0;
  QTest::newRow("2.5") << 2.5 << false << 9.0;
  QTest::newRow("all that is the largest") << 1.0 << true << 0.0;
}

void TestLesion::aConeIsABallOfItsShare() {
  QFETCH(double, amount);
  QFETCH(bool, isShare);
  QFETCH(double, radius);
  const VolumePtr volume = coneVolume();
  const auto made = lesionIn(voxelBall(volume->geometry(), {17, 15, 15}, 13), *volume, {amount, isShare});
  QVERIFY2(bool(made), made ? "" : made.message().c_str());
  QVERIFY(*made == voxelBall(volume->geometry(), coneMiddle, radius + 1e-6));
}

void TestLesion::refusedInOneSentence_data() {
  QTest::addColumn<double>("radius");
  QTest::addColumn<double>("amount");
  QTest::addColumn<bool>("isShare");
  QTest::addColumn<QString>("says");
  QTest::newRow("the ball ends in it") << 6.0 << 0.41 << true << "reaches the border";
  QTest::newRow("the threshold is above all") << 6.0 << 11.0 << false << "no value of the region reaches";
  QTest::newRow("no voxel") << -1.0 << 0.41 << true << "no voxel of the region";
}

void TestLesion::refusedInOneSentence() {
  QFETCH(double, radius);
  QFETCH(double, amount);
  QFETCH(bool, isShare);
  QFETCH(QString, says);
  const VolumePtr volume = coneVolume();
  const auto made = lesionIn(voxelBall(volume->geometry(), coneMiddle, radius), *volume, {amount, isShare});
  QVERIFY(!made);
  QVERIFY2(QString::fromStdString(made.message()).contains(says), made.message().c_str());
}

// The end of the grid is not a leak, as there is no tissue beyond.
void TestLesion::theEndOfTheGridIsNoLeak() {
  const VolumePtr volume = volumeOf<std::int16_t>({5, 5, 3}, glm::dmat3(1), [](glm::dvec3) { return 7; });
  const auto made = lesionIn(inverted(BitMask(volume->geometry())), *volume, {0.41, true});
  QVERIFY(made && made->count() == 75);
}

VOLUMEN_TEST(TestLesion);
#include "tst_lesion.moc"
