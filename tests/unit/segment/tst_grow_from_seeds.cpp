// Guards grow_from_seeds.h: the position of borders between seeds, the reach of growing, refusals, and
// cancelling.
#include <QElapsedTimer>
#include <chrono>
#include <glm/common.hpp>
#include <thread>
#include <vector>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/segment/seed_growth.h"
#include "tests/unit/suite.h"
#include "viewer/segment/grow_from_seeds.h"

using namespace volumen;
using namespace volumen::tests;

class TestGrowFromSeeds : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void evenValuesShareByDistance();
  void aStepBetweenValuesIsTheBorder_data();
  void aStepBetweenValuesIsTheBorder();
  void localityKeepsFromWanderingFar();
  void isToldHowFarItIs();
  void grownOnlyWithinTheMargin_data();
  void grownOnlyWithinTheMargin();
  void valuesFarOutsideTheRangeCountAsThatFar();
  void refusedInOneSentence_data();
  void refusedInOneSentence();
  void cancelledWithinAFifthOfASecond();
};

namespace {

LabelMap seedsAt(const VoxelGeometry& grid, const std::vector<std::pair<glm::ivec3, int>>& seeds) {
  LabelEdit edit{LabelMap(grid)};
  for (const auto& [at, label] : seeds) edit.set(at, std::uint8_t(label));
  return edit.done();
}

}  // namespace

void TestGrowFromSeeds::evenValuesShareByDistance() {
  // Expects city-block distances in mm. At equal distances the smaller label wins.
  VoxelGeometry grid;
  grid.size = {40, 35, 20};
  grid.patientFromVoxelStep = {0.5, 0, 0, 0, 1, 0, 0, 0, 2};
  const VolumePtr volume =
      volumeFrom({grid, std::vector<std::int16_t>(std::size_t(grid.voxelCount()), 70), 1, 0, {}});
  const std::vector<std::pair<glm::ivec3, int>> seeds = {
      {{3, 3, 3}, 9}, {{30, 3, 10}, 4}, {{20, 30, 3}, 200}};
  const auto labels = grownFromSeeds(*volume, seedsAt(grid, seeds), {0.125, everywhere});  // integer costs
  QVERIFY(labels.ok());
  int wrong = 0;
  forVoxels(grid.size, [&](glm::ivec3 v) {
    int nearest = 0;
    double least = everywhere;
    for (const auto& [at, label] : seeds) {
      const glm::dvec3 mm = glm::abs(glm::dvec3(v - at)) * glm::dvec3(0.5, 1, 2);
      const double distance = mm.x + mm.y + mm.z;
      if (distance < least || (distance == least && label < nearest)) least = distance, nearest = label;
    }
    wrong += labels->at(v) != nearest;
  });
  QCOMPARE(wrong, 0);
}

void TestGrowFromSeeds::aStepBetweenValuesIsTheBorder_data() {
  QTest::addColumn<double>("locality");
  for (double locality : {0.0, 0.0005, 0.002}) QTest::addRow("locality %g", locality) << locality;
}

void TestGrowFromSeeds::aStepBetweenValuesIsTheBorder() {
  QFETCH(double, locality);
  // The ball is far off the middle between the seeds. Noise has up to 12 of 100.
  const auto isIn = [](glm::dvec3 v) { return glm::length(v - glm::dvec3(30, 24, 24)) < 17; };
  Chance chance(5);
  const VolumePtr volume =
      valuesBy({64, 48, 48}, [&](glm::dvec3 v) { return (isIn(v) ? 100 : 0) + chance.between(-6, 6); });
  const auto labels = grownFromSeeds(
      *volume, seedsAt(volume->geometry(), {{{20, 20, 20}, 1}, {{60, 40, 40}, 2}, {{2, 2, 2}, 2}}),
      {locality, everywhere});
  QVERIFY(labels.ok());
  int wrong = 0;
  forVoxels(volume->size(), [&](glm::ivec3 v) { wrong += labels->at(v) != (isIn(glm::dvec3(v)) ? 1 : 2); });
  QCOMPARE(wrong, 0);
}

void TestGrowFromSeeds::localityKeepsFromWanderingFar() {
  // The ring has one value. One seed lies across it, behind a step of a tenth of the range, and one far along
  // it.
  const VolumePtr volume = valuesBy({120, 9, 1}, [](glm::dvec3 v) {
    return v.x < 1 ? 1000 : v.y == 4 ? 0 : 100;
  });
  const LabelMap seeds = seedsAt(volume->geometry(), {{{110, 4, 0}, 1}, {{10, 2, 0}, 2}});
  const auto byValues = grownFromSeeds(*volume, seeds, {0, everywhere});
  const auto byLength = grownFromSeeds(*volume, seeds, {0.01, everywhere});
  QVERIFY(byValues.ok() && byLength.ok());
  QCOMPARE(int(byValues->at({10, 4, 0})), 1);  // 100 steps at almost no cost
  QCOMPARE(int(byLength->at({10, 4, 0})), 2);  // 100 mm cost as much as the whole range
}

void TestGrowFromSeeds::isToldHowFarItIs() {
  const VolumePtr volume = valuesBy({60, 50, 40}, [](glm::dvec3 v) { return v.x; });
  const CancelToken cancel;
  QVERIFY(grownFromSeeds(*volume, seedsAt(volume->geometry(), {{{5, 5, 5}, 1}, {{50, 40, 30}, 2}}),
                         {0.002, everywhere}, cancel)
              .ok());
  QVERIFY2(std::abs(cancel.done() - 1) < 1e-4, "all but the seeds themselves");
}

void TestGrowFromSeeds::grownOnlyWithinTheMargin_data() {
  QTest::addColumn<double>("marginMm");
  QTest::addColumn<glm::ivec3>("reach");
  QTest::newRow("none: the box of the seeds") << 0.0 << glm::ivec3(0);
  QTest::newRow("less than a voxel of two axes") << 0.9 << glm::ivec3(1, 0, 0);
  QTest::newRow("3 mm") << 3.0 << glm::ivec3(6, 3, 1);
  QTest::newRow("beyond the grid") << 1000.0 << glm::ivec3(1000);
}

void TestGrowFromSeeds::grownOnlyWithinTheMargin() {
  QFETCH(double, marginMm);
  QFETCH(glm::ivec3, reach);
  VoxelGeometry grid;
  grid.size = {50, 40, 36};
  grid.patientFromVoxelStep = {0.5, 0, 0, 0, 1, 0, 0, 0, 2};
  const VolumePtr volume =
      volumeFrom({grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()), 1), 1, 0, {}});
  const auto labels =
      grownFromSeeds(*volume, seedsAt(grid, {{{20, 20, 18}, 1}, {{30, 22, 20}, 2}}), {0.01, marginMm});
  QVERIFY(labels.ok());
  int wrong = 0;
  forVoxels(grid.size, [&](glm::ivec3 v) {
    const bool isIn = glm::all(glm::greaterThanEqual(v, glm::ivec3(20, 20, 18) - reach)) &&
                      glm::all(glm::lessThanEqual(v, glm::ivec3(30, 22, 20) + reach));
    wrong += (labels->at(v) != 0) != isIn;
  });
  QCOMPARE(wrong, 0);
}

void TestGrowFromSeeds::valuesFarOutsideTheRangeCountAsThatFar() {
  // One voxel of 1e30 must not hide the differences between values of 0 and 10.
  const VolumePtr volume = volumeOf<float>({30, 20, 10}, glm::dmat3(1), [](glm::dvec3 v) {
    return v == glm::dvec3(0) ? 1e30 : v.x < 21 ? 0 : 10;
  });
  const auto labels = grownFromSeeds(*volume, seedsAt(volume->geometry(), {{{2, 9, 5}, 1}, {{28, 9, 5}, 2}}),
                                     {0, everywhere});
  QVERIFY(labels.ok());
  for (int x = 1; x < 30; ++x) QCOMPARE(int(labels->at({x, 12, 7})), x < 21 ? 1 : 2);
}

void TestGrowFromSeeds::refusedInOneSentence_data() {
  QTest::addColumn<int>("labels");
  QTest::addColumn<bool>("cancelled");
  QTest::addColumn<QString>("says");
  QTest::newRow("no seeds") << 0 << false << "at least two segments";
  QTest::newRow("one label") << 1 << false << "at least two segments";
  QTest::newRow("cancelled") << 2 << true << "cancelled";
}

void TestGrowFromSeeds::refusedInOneSentence() {
  QFETCH(int, labels);
  QFETCH(bool, cancelled);
  QFETCH(QString, says);
  const VolumePtr volume = valuesBy({9, 9, 9}, [](glm::dvec3 v) { return v.x; });
  std::vector<std::pair<glm::ivec3, int>> seeds;
  for (int n = 1; n <= labels; ++n)
    seeds.push_back({glm::ivec3(n), n}), seeds.push_back({glm::ivec3(n, 7, 7), n});
  const CancelToken cancel;
  if (cancelled) cancel.cancel();
  const auto grown = grownFromSeeds(*volume, seedsAt(volume->geometry(), seeds), {}, cancel);
  QVERIFY(!grown.ok());
  QVERIFY(QString::fromStdString(grown.message()).contains(says));
}

void TestGrowFromSeeds::cancelledWithinAFifthOfASecond() {
  const VolumePtr volume =
      valuesBy({192, 192, 192}, [](glm::dvec3 v) { return int(v.x * 7 + v.y * 13 + v.z * 3) % 97; });
  const LabelMap seeds = seedsAt(volume->geometry(), {{{5, 5, 5}, 1}, {{180, 180, 180}, 2}});
  const CancelToken cancel;
  QElapsedTimer since;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    since.start();
    cancel.cancel();
  });
  const auto grown = grownFromSeeds(*volume, seeds, {0.002, everywhere}, cancel);
  const qint64 tookMs = since.isValid() ? since.elapsed() : 0;
  canceller.join();
  QVERIFY(grown.ok() || tookMs < 1000);  // about 200 ms on an idle machine
}

VOLUMEN_TEST(TestGrowFromSeeds);
#include "tst_grow_from_seeds.moc"
