// Guards the distance field: it is what a search of all voxels finds.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/distance_field.h"

using namespace volumen;
using namespace volumen::tests;

class TestDistanceField : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void asFoundByLookingAtAll();
  void infiniteWhereThereIsNone();
};

void TestDistanceField::asFoundByLookingAtAll() {
  const Seeds seeds = seedsOf(300, 20000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid;
    grid.size = {1 + chance.below(12), 1 + chance.below(9), 1 + chance.below(7)};
    for (int axis = 0; axis < 3; ++axis) grid.patientFromVoxelStep[axis] *= chance.between(0.3, 5);
    BitMask mask(grid);
    const std::vector<glm::ivec3> voxels = voxelsOf(grid);
    const int many = 1 + chance.below(20);
    for (int n = 0; n < many; ++n) mask.set(voxels[std::size_t(chance.below(int(voxels.size())))]);
    const std::vector<float> field = distancesFrom(mask);
    for (std::size_t n = 0; n < voxels.size(); ++n) {
      double nearest = 1e9;
      for (const glm::ivec3 to : voxels)
        if (mask.at(to))
          nearest = std::min(nearest, glm::length(grid.patientFromVoxelStep * glm::dvec3(to - voxels[n])));
      QVERIFY2(std::abs(field[n] - nearest) < 1e-4 * (1 + nearest),
               qPrintable(QStringLiteral("seed %1, voxel %2: %3 mm in place of %4")
                              .arg(seed)
                              .arg(n)
                              .arg(double(field[n]))
                              .arg(nearest)));
    }
  }
}

void TestDistanceField::infiniteWhereThereIsNone() {
  for (const float distance : distancesFrom(BitMask({.size = {3, 2, 2}}))) QVERIFY(std::isinf(distance));
}

VOLUMEN_TEST(TestDistanceField);
#include "tst_distance_field.moc"
