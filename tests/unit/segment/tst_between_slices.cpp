// Guards between_slices.h: signed distances against brute force, and components that change into one another.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/between_slices.h"

using namespace volumen;
using namespace volumen::tests;

class TestBetweenSlices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void distancesAreThoseOfBruteForce();
  void discsBecomeCones_data();
  void discsBecomeCones();
  void apartOnesMove_data();
  void apartOnesMove();
  void eachMovesToTheNearest();
  void nothingToFill_data();
  void nothingToFill();
  void fullSlicesFillAll();
  void whatLeavesTheGridIsLost();
  void cancelledChangesNothing();
  void theAxisIsThatOfPaintedSlices_data();
  void theAxisIsThatOfPaintedSlices();
};

namespace {

VoxelGeometry gapGrid(glm::ivec3 size) {
  VoxelGeometry grid;
  grid.size = size;
  return grid;
}

bool discAt(glm::ivec3 v, glm::dvec2 middle, double radius) {
  return glm::length(glm::dvec2(v.x, v.y) - middle) <= radius;
}

// Returns the signed distance (mm) in a slice from a voxel to the outline, by testing all voxels of the
// slice.
double signedDistance(const BitMask& mask, int axis, int slice, glm::ivec3 from) {
  from[axis] = slice;
  const bool in = mask.at(from);
  double nearest = std::numeric_limits<double>::infinity();
  forVoxels(mask.size(), [&](glm::ivec3 v) {
    if (v[axis] == slice && mask.at(v) != in)
      nearest = std::min(nearest, glm::length(mask.geometry().patientFromVoxelStep * glm::dvec3(v - from)));
  });
  if (std::isinf(nearest)) {
    glm::dvec3 diagonal(mask.size());
    diagonal[axis] = 0;
    nearest = glm::length(mask.geometry().patientFromVoxelStep * diagonal);
  }
  return in ? -nearest : nearest;
}

// Keeps in a slice only the component of a voxel, connected also through corners.
void keepPartOf(BitMask& mask, int axis, glm::ivec3 from) {
  std::vector<glm::ivec3> reached = {from};
  BitMask part(mask.geometry());
  part.set(from);
  for (std::size_t n = 0; n < reached.size(); ++n)
    forVoxels(glm::ivec3(3), [&](glm::ivec3 by) {
      const glm::ivec3 v = reached[n] + by - 1;
      if (by[axis] != 1 || glm::any(glm::lessThan(v, glm::ivec3(0))) ||
          glm::any(glm::greaterThanEqual(v, mask.size())) || !mask.at(v) || part.at(v))
        return;
      part.set(v);
      reached.push_back(v);
    });
  forVoxels(mask.size(), [&](glm::ivec3 v) {
    if (v[axis] == from[axis]) mask.set(v, part.at(v));
  });
}

// Returns random painted slices, all others empty. All painted slices hold the middle voxel, and every second
// one has a single component. Thus no component is unmatched, and none moves.
BitMask slicesThatStay(Chance& chance, const VoxelGeometry& grid, int axis, const std::vector<int>& painted) {
  const BitMask any = anyMask(chance, grid);
  BitMask mask(grid);
  for (std::size_t n = 0; n < painted.size(); ++n) {
    forVoxels(grid.size, [&](glm::ivec3 v) {
      if (v[axis] == painted[n]) mask.set(v, any.at(v));
    });
    glm::ivec3 middle = grid.size / 2;
    middle[axis] = painted[n];
    mask.set(middle);
    if (n % 2) keepPartOf(mask, axis, middle);
  }
  return mask;
}

}  // namespace

void TestBetweenSlices::distancesAreThoseOfBruteForce() {
  const Seeds seeds = seedsOf(400, 4000);
  std::int64_t filledIn = 0, leftOut = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid = anyGrid(chance, 8);
    const int axis = chance.below(3);
    grid.size.x = std::min(grid.size.x, 12);
    grid.size[axis] = 3 + chance.below(9);
    std::vector<int> painted = {chance.below(2)};
    while (painted.back() + 1 < grid.size[axis]) {
      const int next = painted.back() + 1 + chance.below(5);
      if (next >= grid.size[axis]) break;
      painted.push_back(next);
    }
    const BitMask mask = slicesThatStay(chance, grid, axis, painted);
    const BitMask filled = filledBetweenSlices(mask, axis);
    int wrong = 0;
    forVoxels(grid.size, [&](glm::ivec3 v) {
      const auto next = std::ranges::upper_bound(painted, v[axis]);
      const bool isPainted = next != painted.begin() && *(next - 1) == v[axis];
      if (isPainted || next == painted.begin() || next == painted.end()) {
        wrong += filled.at(v) != mask.at(v);
        return;
      }
      const int from = *(next - 1), to = *next;
      const double share = double(v[axis] - from) / (to - from);
      const double sum =
          (1 - share) * signedDistance(mask, axis, from, v) + share * signedDistance(mask, axis, to, v);
      (filled.at(v) ? filledIn : leftOut) += 1;
      wrong += filled.at(v) != (sum <= 1e-7);
    });
    QVERIFY2(wrong == 0, qPrintable(QStringLiteral("seed %1: %2 voxels").arg(seed).arg(wrong)));
  }
  QVERIFY(seeds.count < 100 || (filledIn > seeds.count && leftOut > seeds.count));
}

void TestBetweenSlices::discsBecomeCones_data() {
  QTest::addColumn<double>("first");
  QTest::addColumn<double>("second");
  QTest::addColumn<double>("spacing");
  QTest::newRow("a cylinder stays one") << 12.0 << 12.0 << 1.0;
  QTest::newRow("a cone") << 20.0 << 8.0 << 1.0;
  QTest::newRow("a cone the other way, oblong voxels") << 6.0 << 18.0 << 2.0;
}

void TestBetweenSlices::discsBecomeCones() {
  QFETCH(double, first);
  QFETCH(double, second);
  QFETCH(double, spacing);
  VoxelGeometry grid = gapGrid({60, 60, 11});
  grid.patientFromVoxelStep[1] *= spacing;
  const BitMask mask = maskWhere(grid, [&](glm::ivec3 v) {
    const glm::dvec2 mm = glm::dvec2(v.x - 30, (v.y - 30) * spacing);
    return (v.z == 0 && glm::length(mm) <= first) || (v.z == 10 && glm::length(mm) <= second);
  });
  const BitMask filled = filledBetweenSlices(mask, 2);
  for (int k = 0; k <= 10; ++k) {
    const double radius = first + (second - first) * k / 10;
    int wrong = 0;
    forVoxels({60, 60, 1}, [&](glm::ivec3 v) {
      const double mm = glm::length(glm::dvec2(v.x - 30, (v.y - 30) * spacing));
      // Outlines of voxels are off by up to one voxel.
      const double off = first == second ? 1e-9 : spacing;
      wrong += std::abs(mm - radius) > off && filled.at({v.x, v.y, k}) != (mm < radius);
    });
    QVERIFY2(wrong == 0, qPrintable(QStringLiteral("slice %1: %2 voxels").arg(k).arg(wrong)));
  }
}

void TestBetweenSlices::apartOnesMove_data() {
  QTest::addColumn<int>("axis");
  for (int axis : {0, 1, 2}) QTest::addRow("across axis %d", axis) << axis;
}

void TestBetweenSlices::apartOnesMove() {
  QFETCH(int, axis);
  const glm::ivec2 turned[] = {{2, 1}, {0, 2}, {0, 1}};  // axes that hold x and y
  const glm::ivec2 to = turned[axis];
  const auto voxel = [&](int x, int y, int slice) {
    glm::ivec3 v;
    v[to.x] = x, v[to.y] = y, v[axis] = slice;
    return v;
  };
  const VoxelGeometry grid = gapGrid(voxel(50, 24, 9));
  BitMask mask(grid);
  const auto paint = [&](int x, int slice) {
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx)
        if (dx * dx + dy * dy <= 9) mask.set(voxel(x + dx, 10 + dy, slice));
  };
  paint(8, 0), paint(40, 8);
  const BitMask filled = filledBetweenSlices(mask, axis);
  for (int slice = 0; slice <= 8; ++slice)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 50; ++x) {
        const int dx = x - (8 + 4 * slice), dy = y - 10;
        QCOMPARE(filled.at(voxel(x, y, slice)), dx * dx + dy * dy <= 9);
      }
}

void TestBetweenSlices::eachMovesToTheNearest() {
  // Two vessels move side by side, a third stays in place, and one ends.
  const VoxelGeometry grid = gapGrid({90, 90, 7});
  const BitMask mask = maskWhere(grid, [](glm::ivec3 v) {
    if (v.z == 0)
      return discAt(v, {10, 10}, 4) || discAt(v, {10, 30}, 4) || discAt(v, {60, 60}, 9) ||
             discAt(v, {80, 20}, 2);
    if (v.z == 6) return discAt(v, {28, 12}, 4) || discAt(v, {28, 36}, 4) || discAt(v, {60, 60}, 9);
    return false;
  });
  const BitMask filled = filledBetweenSlices(mask, 2);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 90; ++x) {
      const glm::ivec3 v(x, y, 3);
      QCOMPARE(filled.at(v), discAt(v, {19, 11}, 4) || discAt(v, {19, 33}, 4) || discAt(v, {60, 60}, 9));
    }
}

void TestBetweenSlices::nothingToFill_data() {
  QTest::addColumn<std::vector<int>>("painted");
  QTest::newRow("no slice") << std::vector<int>{};
  QTest::newRow("one") << std::vector{4};
  QTest::newRow("neighbours") << std::vector{3, 4, 5};
}

void TestBetweenSlices::nothingToFill() {
  QFETCH(std::vector<int>, painted);
  for (int axis : {0, 1, 2}) {
    const BitMask mask = maskWhere(gapGrid({9, 9, 9}), [&](glm::ivec3 v) {
      return std::ranges::find(painted, v[axis]) != painted.end() && (v.x + v.y + v.z) % 3 == 0;
    });
    QVERIFY(filledBetweenSlices(mask, axis) == mask);
  }
  const BitMask one = maskWhere(gapGrid({1, 1, 1}), [](glm::ivec3) { return true; });
  QVERIFY(filledBetweenSlices(one, 2) == one);
}

void TestBetweenSlices::fullSlicesFillAll() {
  for (int axis : {0, 1, 2}) {
    const VoxelGeometry grid = gapGrid({70, 5, 8});
    const BitMask ends =
        maskWhere(grid, [&](glm::ivec3 v) { return v[axis] == 0 || v[axis] == grid.size[axis] - 1; });
    QCOMPARE(filledBetweenSlices(ends, axis).count(), grid.voxelCount());
  }
}

void TestBetweenSlices::whatLeavesTheGridIsLost() {
  // A corner of the first slice becomes a large disc that would extend beyond the grid on the way.
  const VoxelGeometry grid = gapGrid({40, 40, 5});
  const BitMask mask = maskWhere(grid, [](glm::ivec3 v) {
    return (v.z == 0 && v.x < 2 && v.y < 2) || (v.z == 4 && discAt(v, {26, 26}, 12));
  });
  const BitMask filled = filledBetweenSlices(mask, 2);
  for (int k = 1; k < 4; ++k) {
    std::int64_t count = 0;
    forVoxels({40, 40, 1}, [&](glm::ivec3 v) { count += filled.at({v.x, v.y, k}); });
    QVERIFY(count > 4 && count < 440);
  }
}

void TestBetweenSlices::cancelledChangesNothing() {
  const BitMask mask = maskWhere(gapGrid({20, 20, 9}), [](glm::ivec3 v) { return v.z % 4 == 0; });
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(filledBetweenSlices(mask, 2, cancel) == mask);
}

void TestBetweenSlices::theAxisIsThatOfPaintedSlices_data() {
  QTest::addColumn<int>("axis");
  for (int axis = 0; axis < 3; ++axis) QTest::addRow("axis %d", axis) << axis;
}

// Each of two slices has two components, which are farther from each other than the slices are.
void TestBetweenSlices::theAxisIsThatOfPaintedSlices() {
  QFETCH(int, axis);
  const VoxelGeometry grid = gapGrid(glm::ivec3(90));
  const int along = (axis + 1) % 3;
  const BitMask mask = maskWhere(grid, [&](glm::ivec3 v) {
    return (v[axis] == 40 || v[axis] == 43) && (v[along] < 10 || v[along] > 70);
  });
  QCOMPARE(axisOfPaintedSlices(mask), std::optional(axis));
  QVERIFY(!axisOfPaintedSlices(BitMask(grid)));
  QVERIFY(!axisOfPaintedSlices(filledBetweenSlices(
      maskWhere(grid, [&](glm::ivec3 v) { return v[axis] == 40 || v[axis] == 43; }), axis)));
}

VOLUMEN_TEST(TestBetweenSlices);
#include "tst_between_slices.moc"
