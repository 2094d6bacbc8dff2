// Guards grow_from_seeds.h: the cheapest paths, compared with a plain queue over the whole grid, with and
// without tile borders.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <queue>
#include <tuple>
#include <vector>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/segment/seed_growth.h"
#include "tests/unit/suite.h"
#include "viewer/segment/grow_from_seeds.h"
#include "viewer/volume/histogram.h"

using namespace volumen;
using namespace volumen::tests;

class TestGrowthTwin : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pathsAreThoseOfBruteForce();
  void pathsCrossTiles();
  void onlyTheGivenVoxelsAreReached();
  void theSameByOneThread();
};

namespace {

// Grows by the costs of grow_from_seeds.h with one queue of all voxels, in order of cost, then label.
std::vector<std::uint8_t> grownByQueue(const Volume& volume, const LabelMap& seeds,
                                       const SeedGrowth& growth) {
  const glm::ivec3 size = volume.size();
  const std::vector<float> at = percentiles(volume, {1, 999});
  double low = at[0], high = at[1];
  if (low == high) low = valueRange(volume).low, high = valueRange(volume).high;
  const auto levelOf = [&](glm::ivec3 v) {
    if (low == high) return std::int64_t(0);
    const double value = std::clamp(double(volume.value(v.x, v.y, v.z)), low - 1.5 * (high - low),
                                    low - 1.5 * (high - low) + 65535. / 16384 * (high - low));
    return std::int64_t(std::floor((value - low) * (16384 / (high - low)) + 24576 + 0.5));
  };
  const auto indexOf = [&](glm::ivec3 v) {
    return (std::size_t(v.z) * size.y + v.y) * std::size_t(size.x) + v.x;
  };
  const auto isOpen = [&](glm::ivec3 v) { return !growth.within || growth.within->at(v); };
  glm::ivec3 from = size, to(-1);
  forVoxels(size, [&](glm::ivec3 v) {
    if (seeds.at(v) && isOpen(v)) from = glm::min(from, v), to = glm::max(to, v);
  });
  const glm::ivec3 margin(glm::min(growth.marginMm / volume.geometry().spacing(), glm::dvec3(1000)));
  from -= margin, to += margin;
  using Entry = std::tuple<std::int64_t, int, int, int, int>;  // cost, label, x, y, z
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<std::uint8_t> labels(std::size_t(volume.geometry().voxelCount()));
  forVoxels(size, [&](glm::ivec3 v) {
    if (!isOpen(v))
      labels[indexOf(v)] = seeds.at(v);
    else if (const int label = seeds.at(v))
      queue.emplace(0, label, v.x, v.y, v.z);
  });
  while (!queue.empty()) {
    const auto [cost, label, x, y, z] = queue.top();
    queue.pop();
    const glm::ivec3 v(x, y, z);
    if (labels[indexOf(v)]) continue;
    labels[indexOf(v)] = std::uint8_t(label);
    for (int axis = 0; axis < 3; ++axis)
      for (int by : {-1, 1}) {
        glm::ivec3 next = v;
        next[axis] += by;
        if (next[axis] < std::max(0, from[axis]) || next[axis] > std::min(size[axis] - 1, to[axis])) continue;
        if (!isOpen(next)) continue;
        const std::int64_t byLength =
            std::lround(growth.locality * 16384 * volume.geometry().spacing()[axis]);
        queue.emplace(cost + std::max<std::int64_t>(1, std::abs(levelOf(v) - levelOf(next)) + byLength),
                      label, next.x, next.y, next.z);
      }
  }
  return labels;
}

template <class T>
VolumePtr anyVolume(Chance& chance, const VoxelGeometry& grid, double steps) {
  VolumeParts parts;
  parts.geometry = grid;
  parts.slope = chance.oneIn(2) ? 1 : -0.37;
  parts.intercept = chance.between(-100, 100);
  std::vector<T> values(std::size_t(grid.voxelCount()));
  for (T& value : values) value = T(std::floor(chance.between(0, steps)));
  parts.values = std::move(values);
  return volumeFrom(std::move(parts));
}

VolumePtr anyVolume(Chance& chance, const VoxelGeometry& grid) {
  const double steps = chance.oneIn(3) ? 3 : chance.oneIn(2) ? 40 : 250;
  switch (chance.below(4)) {
    case 0:
      return anyVolume<std::uint8_t>(chance, grid, steps);
    case 1:
      return anyVolume<std::int16_t>(chance, grid, steps);
    case 2:
      return anyVolume<std::uint16_t>(chance, grid, steps * 200);
    default:
      return anyVolume<float>(chance, grid, steps);
  }
}

LabelMap anySeeds(Chance& chance, const VoxelGeometry& grid, int count) {
  LabelEdit edit{LabelMap(grid)};
  const int labels[] = {1, 2, 7, 255};
  for (int n = 0; n < count; ++n)
    edit.set(glm::ivec3(chance.below(grid.size.x), chance.below(grid.size.y), chance.below(grid.size.z)),
             std::uint8_t(labels[n % 4]));
  return edit.done();
}

std::vector<std::uint8_t> allOf(const LabelMap& map) { return map.dense().labels; }

}  // namespace

void TestGrowthTwin::pathsAreThoseOfBruteForce() {
  const Seeds cases = seedsOf(500, 10000);
  int grown = 0;
  for (int seed = cases.first; seed < cases.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VoxelGeometry grid = anyGrid(chance, 8);
    const VolumePtr volume = anyVolume(chance, grid);
    const LabelMap seeds = anySeeds(chance, grid, 2 + chance.below(6));
    const SeedGrowth growth{chance.oneIn(3) ? 0 : chance.power(-4, 0),
                            chance.oneIn(2) ? everywhere : chance.between(0, 5)};
    const auto labels = grownFromSeeds(*volume, seeds, growth);
    if (!labels) continue;  // all seeds are in one voxel
    ++grown;
    QVERIFY2(allOf(*labels) == grownByQueue(*volume, seeds, growth),
             qPrintable(QStringLiteral("seed %1").arg(seed)));
  }
  QVERIFY(cases.count < 100 || grown > cases.count / 2);
}

void TestGrowthTwin::pathsCrossTiles() {
  // The grid has several tiles of 32 along each axis, the last ones partial. Paths wind through them.
  const Seeds cases = seedsOf(3, 60);
  for (int seed = cases.first; seed < cases.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid;
    grid.size = {70 + chance.below(30), 33 + chance.below(40), 40 + chance.below(30)};
    grid.patientFromVoxelStep = grids[chance.below(5)].patientFromVoxelStep;
    const VolumePtr volume = anyVolume(chance, grid);
    const LabelMap seeds = anySeeds(chance, grid, 2 + chance.below(20));
    for (const SeedGrowth& growth : {SeedGrowth{}, SeedGrowth{0, everywhere}, SeedGrowth{0.5, everywhere}}) {
      const auto labels = grownFromSeeds(*volume, seeds, growth);
      QVERIFY(labels.ok());
      QVERIFY2(allOf(*labels) == grownByQueue(*volume, seeds, growth),
               qPrintable(QStringLiteral("seed %1").arg(seed)));
    }
  }
}

// Labels outside stay, are no seeds, and block growing.
void TestGrowthTwin::onlyTheGivenVoxelsAreReached() {
  const Seeds cases = seedsOf(500, 10000);
  int grown = 0;
  for (int seed = cases.first; seed < cases.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VoxelGeometry grid = anyGrid(chance, 40);
    const VolumePtr volume = anyVolume(chance, grid);
    const LabelMap seeds = anySeeds(chance, grid, 2 + chance.below(12));
    const BitMask within = chance.oneIn(2) ? anyMask(chance, grid) : inverted(maskOf(seeds, 2));
    const SeedGrowth growth{chance.oneIn(3) ? 0 : chance.power(-4, 0),
                            chance.oneIn(2) ? everywhere : chance.between(0, 5), &within};
    const auto labels = grownFromSeeds(*volume, seeds, growth);
    if (!labels) continue;  // fewer than two labels are left
    ++grown;
    QVERIFY2(allOf(*labels) == grownByQueue(*volume, seeds, growth),
             qPrintable(QStringLiteral("seed %1").arg(seed)));
  }
  QVERIFY(cases.count < 100 || grown > cases.count / 2);
  // A brick has one label that is no seed.
  const VolumePtr volume = valuesBy({40, 34, 33}, [](glm::dvec3 v) { return v.x; });
  const LabelMap all = withLabel(LabelMap(volume->geometry()), 3, inverted(BitMask(volume->geometry())));
  const BitMask none(volume->geometry());
  QVERIFY(!grownFromSeeds(*volume, all, {0.002, everywhere, &none}));
}

void TestGrowthTwin::theSameByOneThread() {
  Chance chance(11);
  VoxelGeometry grid;
  grid.size = {100, 90, 80};
  const VolumePtr volume = anyVolume<std::int16_t>(chance, grid, 100);
  const LabelMap seeds = anySeeds(chance, grid, 12);
  const auto all = grownFromSeeds(*volume, seeds, {0.002, everywhere});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = grownFromSeeds(*volume, seeds, {0.002, everywhere});
  QVERIFY(all.ok() && alone.ok() && *all == *alone);
}

VOLUMEN_TEST(TestGrowthTwin);
#include "tst_growth_twin.moc"
