// Guards labels_on.h, against an implementation that tests all pairs of voxels, and segmentedOf().
#include <algorithm>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/segment/labels_on.h"
#include "viewer/segment/segmentation.h"

using namespace volumen;
using namespace volumen::tests;

class TestLabelsOn : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachVoxelHasWhatTheOneThatHoldsItHas();
  void aGridThatIsNearlyTheSameChangesNothing();
  void segmentsThatOverlapGetMapsOfTheirOwn();
  void moreSegmentsThanLabelsGoOnInAnotherMap();
};

namespace {

LabelMap randomLabels(const VoxelGeometry& grid, Chance& chance) {
  DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  for (std::uint8_t& label : dense.labels) label = std::uint8_t(chance.below(256));
  return LabelMap(dense);
}

VoxelGeometry randomGrid(Chance& chance) {
  VoxelGeometry grid;
  grid.size = {1 + chance.below(9), 1 + chance.below(9), 1 + chance.below(9)};
  grid.patientFromVoxelStep = chance.between(0.5, 1.5) * grids[chance.below(5)].patientFromVoxelStep;
  grid.origin = 3.0 * chance.vector();
  return grid;
}

/// Returns one frame of 8 x 1 pixels for each segment with its pixels, all in one plane.
Segmentation inOnePlane(const std::vector<std::vector<int>>& pixels) {
  Segmentation s;
  s.size = {8, 1};
  BitPacker bits;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    s.segments.push_back({.number = int(n) + 1});
    s.frames.push_back({n, {0, 0, 0}});
    std::uint64_t row = 0;
    for (const int pixel : pixels[n]) row |= std::uint64_t(1) << pixel;
    bits.add(row, 8);
  }
  s.bits = bits.bytes();
  return s;
}

}  // namespace

void TestLabelsOn::eachVoxelHasWhatTheOneThatHoldsItHas() {
  const Seeds seeds = seedsOf(300, 3000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const LabelMap from = randomLabels(randomGrid(chance), chance);
    const VoxelGeometry grid = randomGrid(chance);
    const LabelMap made = labelsOn(from, grid);
    QVERIFY(made.geometry() == grid);
    for (int n = 0; n < grid.size.x * grid.size.y * grid.size.z; ++n) {
      const glm::ivec3 v(n % grid.size.x, n / grid.size.x % grid.size.y, n / grid.size.x / grid.size.y);
      const glm::dvec3 p = from.geometry().voxelFromPatient(grid.patientFromVoxel(glm::dvec3(v)));
      // On the face between two voxels either is right.
      const glm::dvec3 inCell = p + 0.5 - glm::floor(p + 0.5);
      if (std::min({inCell.x, inCell.y, inCell.z}) < 1e-9 ||
          std::max({inCell.x, inCell.y, inCell.z}) > 1 - 1e-9)
        continue;
      int expected = 0;
      for (int k = 0; k < from.geometry().size.z; ++k)
        for (int j = 0; j < from.geometry().size.y; ++j)
          for (int i = 0; i < from.geometry().size.x; ++i)
            if (const glm::dvec3 off = glm::abs(p - glm::dvec3(i, j, k));
                std::max({off.x, off.y, off.z}) < 0.5)
              expected = from.at({i, j, k});
      if (made.at(v) != expected) QFAIL(qPrintable(QStringLiteral("seed %1, voxel %2").arg(seed).arg(n)));
    }
  }
}

void TestLabelsOn::aGridThatIsNearlyTheSameChangesNothing() {
  Chance chance(7);
  for (const Grid& shape : grids) {
    VoxelGeometry grid;
    grid.size = {40, 33, 5};
    grid.patientFromVoxelStep = shape.patientFromVoxelStep;
    const LabelMap from = randomLabels(grid, chance);
    grid.origin += glm::dvec3(0.001, -0.002, 0.003);
    grid.patientFromVoxelStep *= 1.0001;
    QVERIFY(areSameVoxels(from.geometry(), grid));
    QCOMPARE(labelsOn(from, grid).dense().labels, from.dense().labels);
    grid.patientFromVoxelStep *= 1.05;
    QVERIFY(!areSameVoxels(from.geometry(), grid));
  }
}

void TestLabelsOn::segmentsThatOverlapGetMapsOfTheirOwn() {
  const Segmentation s = inOnePlane({{0, 1, 2}, {2, 3}, {4}, {3, 5}, {}});
  VoxelGeometry grid;
  grid.size = {8, 1, 1};
  const std::vector<Segmented> maps = segmentedOf(s, grid);
  QCOMPARE(maps.size(), std::size_t(2));
  const std::vector<std::uint8_t> first{1, 1, 1, 4, 3, 4, 0, 0}, second{0, 0, 2, 2, 0, 0, 0, 0};
  QCOMPARE(maps[0].labels.dense().labels, first);
  QCOMPARE(maps[1].labels.dense().labels, second);
  QCOMPARE(maps[0].segments.size(), std::size_t(4));
  QCOMPARE(maps[1].segments.size(), std::size_t(1));
}

void TestLabelsOn::moreSegmentsThanLabelsGoOnInAnotherMap() {
  std::vector<std::vector<int>> pixels(300);
  pixels[299] = {5};
  VoxelGeometry grid;
  grid.size = {8, 1, 1};
  const std::vector<Segmented> maps = segmentedOf(inOnePlane(pixels), grid);
  QCOMPARE(maps.size(), std::size_t(2));
  QCOMPARE(maps[0].segments.size(), std::size_t(255));
  QCOMPARE(maps[1].segments.size(), std::size_t(45));
  QCOMPARE(maps[1].segments.back().number, int(maps[1].labels.at({5, 0, 0})));
  QVERIFY(maps[1].segments.back().number >= 1);
}

VOLUMEN_TEST(TestLabelsOn);
#include "tst_labels_on.moc"
