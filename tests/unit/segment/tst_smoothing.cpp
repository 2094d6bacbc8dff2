// Guards smoothing.h: the same voxels as by sums over all voxels of the kernel, on every grid.
#include <tbb/global_control.h>

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/smoothing.h"

using namespace volumen;
using namespace volumen::tests;

class TestSmoothing : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void medianIsThatOfBruteForce();
  void gaussianIsThatOfBruteForce();
  void jointIsThatOfBruteForce();
  void whatIsEvenStays_data();
  void whatIsEvenStays();
  void slabsLiveByTheirThicknessInMm_data();
  void slabsLiveByTheirThicknessInMm();
  void ballsShrinkByTheSquareOfSigma();
  void labelsLeaveNoGap();
  void ofTwoLabelsAlikeTheSmallerWins();
  void lockedLabelsNeitherGainNorLose();
  void bricksThatStayAreShared();
  void theSameByOneThread();
  void cancelledEndsSoon();
};

namespace {

const Seeds maskSeeds = seedsOf(400, 4000);

glm::ivec3 inGrid(glm::ivec3 v, glm::ivec3 size) { return glm::clamp(v, glm::ivec3(0), size - 1); }

bool axesAreOrthogonal(const glm::dmat3& step) {
  return std::abs(glm::dot(step[0], step[1])) + std::abs(glm::dot(step[1], step[2])) +
             std::abs(glm::dot(step[2], step[0])) <
         1e-9;
}

struct KernelVoxel {
  glm::ivec3 at;
  double weight;
};

// Returns all voxels of the Gaussian, cut at 4 standard deviations. The limit is along each axis if axes are
// orthogonal, else by distance.
std::vector<KernelVoxel> kernelOf(const VoxelGeometry& grid, double sigma) {
  const glm::dmat3 step = grid.patientFromVoxelStep;
  const bool isBox = axesAreOrthogonal(step);
  const int far = int(std::ceil(12 * sigma));  // no step of `grids` is oblique enough to need more
  std::vector<KernelVoxel> kernel;
  double sum = 0;
  for (int z = -far; z <= far; ++z)
    for (int y = -far; y <= far; ++y)
      for (int x = -far; x <= far; ++x) {
        const glm::dvec3 v(x, y, z);
        const double mm = glm::length(step * v);
        const glm::dvec3 along = glm::abs(v) * grid.spacing();
        if (isBox ? std::max({along.x, along.y, along.z}) > 4 * sigma : mm > 4 * sigma) continue;
        kernel.push_back({glm::ivec3(x, y, z), std::exp(-0.5 * mm * mm / (sigma * sigma))});
        sum += kernel.back().weight;
      }
  for (KernelVoxel& one : kernel) one.weight /= sum;
  return kernel;
}

double occupancyAt(const std::vector<KernelVoxel>& kernel, glm::ivec3 v, glm::ivec3 size, const auto& isIn) {
  double sum = 0;
  for (const KernelVoxel& one : kernel) sum += isIn(inGrid(v + one.at, size)) ? one.weight : 0;
  return sum;
}

LabelMap labelsOf(const VoxelGeometry& grid, const auto& labelAt) {
  LabelEdit edit{LabelMap(grid)};
  forVoxels(grid.size, [&](glm::ivec3 v) { edit.set(v, std::uint8_t(labelAt(v))); });
  return edit.done();
}

VoxelGeometry cube(int edge, const glm::dmat3& step = glm::dmat3(1)) {
  VoxelGeometry grid;
  grid.size = glm::ivec3(edge);
  grid.patientFromVoxelStep = step;
  return grid;
}

}  // namespace

void TestSmoothing::medianIsThatOfBruteForce() {
  std::int64_t changed = 0;
  for (int seed = maskSeeds.first; seed < maskSeeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const BitMask mask = anyMask(chance, anyGrid(chance, 9));
    const VoxelGeometry& grid = mask.geometry();
    const double radius = chance.between(0, 2.6);
    const BitMask smoothed = medianSmoothed(mask, radius);
    bool same = true;
    forVoxels(grid.size, [&](glm::ivec3 v) {
      int more = 0;
      forVoxels(grid.size, [&](glm::ivec3 other) {
        if (glm::length(grid.patientFromVoxelStep * glm::dvec3(other - v)) <= radius)
          more += mask.at(other) ? 1 : -1;
      });
      same = same && smoothed.at(v) == (more == 0 ? mask.at(v) : more > 0);
      changed += smoothed.at(v) != mask.at(v);
    });
    QVERIFY2(same, qPrintable(QStringLiteral("seed %1").arg(seed)));
    QVERIFY(smoothed.count() <= grid.voxelCount());  // no bits beyond the grid
  }
  QVERIFY2(maskSeeds.count < 100 || changed > 10 * maskSeeds.count, "or the cases show little");
}

void TestSmoothing::gaussianIsThatOfBruteForce() {
  std::int64_t changed = 0, open = 0;
  for (int seed = maskSeeds.first; seed < maskSeeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const BitMask mask = anyMask(chance, anyGrid(chance, 7));
    const double sigma = chance.between(0.2, 1.1);
    const BitMask smoothed = gaussianSmoothed(mask, sigma);
    const auto kernel = kernelOf(mask.geometry(), sigma);
    // Tests every seventh voxel of long grids, which still covers the ends of words.
    int n = 0;
    bool same = true;
    forVoxels(mask.size(), [&](glm::ivec3 v) {
      if (mask.size().x > 9 && n++ % 7) return;
      const double sum = occupancyAt(kernel, v, mask.size(), [&](glm::ivec3 at) { return mask.at(at); });
      changed += smoothed.at(v) != mask.at(v);
      if (std::abs(sum - 0.5) < 1e-5)
        ++open;  // closer than floats resolve
      else
        same = same && smoothed.at(v) == (sum > 0.5);
    });
    QVERIFY2(same, qPrintable(QStringLiteral("seed %1").arg(seed)));
    QVERIFY(smoothed.count() <= mask.geometry().voxelCount());
  }
  QVERIFY2(maskSeeds.count < 100 || changed > 4 * maskSeeds.count, "or the cases show little");
  QVERIFY(open <= changed / 10);
}

void TestSmoothing::jointIsThatOfBruteForce() {
  std::int64_t changed = 0;
  for (int seed = maskSeeds.first; seed < maskSeeds.first + maskSeeds.count / 2; ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VoxelGeometry grid = anyGrid(chance, 6);
    const BitMask one = anyMask(chance, grid), two = anyMask(chance, grid);
    const LabelMap map = labelsOf(grid, [&](glm::ivec3 v) {
      return two.at(v) ? 7 : one.at(v) ? 2 : chance.oneIn(9) ? 255 : 0;
    });
    const std::vector<std::uint8_t> locked =
        chance.oneIn(2) ? std::vector<std::uint8_t>{}
                        : std::vector<std::uint8_t>{std::uint8_t(chance.oneIn(2) ? 2 : 255)};
    const double sigma = chance.between(0.2, 1);
    const LabelMap smoothed = jointSmoothed(map, sigma, locked);
    const auto kernel = kernelOf(grid, sigma);
    const auto isLocked = [&](std::uint8_t label) {
      return std::ranges::find(locked, label) != locked.end();
    };
    int n = 0, wrong = 0;
    forVoxels(grid.size, [&](glm::ivec3 v) {
      const std::uint8_t own = map.at(v), now = smoothed.at(v);
      changed += own != now;
      if (isLocked(own) || isLocked(now)) {
        wrong += now != own;
        return;
      }
      if (grid.size.x > 9 && n++ % 7) return;
      const auto occupancyOf = [&](std::uint8_t label) {
        return occupancyAt(kernel, v, grid.size, [&](glm::ivec3 at) { return map.at(at) == label; });
      };
      double most = 0;
      for (std::uint8_t label : {0, 2, 7, 255})
        if (!isLocked(label)) most = std::max(most, occupancyOf(label));
      wrong += occupancyOf(now) < most - 1e-5 || (occupancyOf(own) > most - 1e-7 && now != own);
    });
    QVERIFY2(wrong == 0, qPrintable(QStringLiteral("seed %1: %2 voxels").arg(seed).arg(wrong)));
  }
  QVERIFY2(maskSeeds.count < 100 || changed > 5 * maskSeeds.count, "or the cases show little");
}

void TestSmoothing::whatIsEvenStays_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("nothing") << 0;
  QTest::newRow("all") << 1;
  QTest::newRow("one half: planes stay, and the border of the grid takes nothing") << 2;
}

void TestSmoothing::whatIsEvenStays() {
  QFETCH(int, kind);
  for (const Grid& shape : grids) {
    const VoxelGeometry grid = cube(19, shape.patientFromVoxelStep);
    const BitMask mask = maskWhere(grid, [&](glm::ivec3 v) { return kind == 1 || (kind == 2 && v.y < 8); });
    for (double size : {0.0, 0.3, 1.0, 2.0}) {
      QVERIFY2(gaussianSmoothed(mask, size) == mask, shape.name);
      if (kind < 2 || size < 2) QVERIFY2(medianSmoothed(mask, size) == mask, shape.name);
    }
  }
}

void TestSmoothing::slabsLiveByTheirThicknessInMm_data() {
  QTest::addColumn<int>("axis");
  QTest::addColumn<double>("spacing");
  QTest::addColumn<double>("sigma");
  QTest::addColumn<bool>("lives");
  // The middle of a slab is at least 1/2 if half its thickness is at least 0.6745 sigma. The slab has 5
  // voxels.
  for (int axis : {0, 1, 2})
    for (double spacing : {0.5, 1.0, 3.0}) {
      QTest::addRow("axis %d, %g mm, just thick enough", axis, spacing)
          << axis << spacing << 0.95 * 2.5 * spacing / 0.6745 << true;
      QTest::addRow("axis %d, %g mm, just too thin", axis, spacing)
          << axis << spacing << 1.05 * 2.5 * spacing / 0.6745 << false;
    }
}

void TestSmoothing::slabsLiveByTheirThicknessInMm() {
  QFETCH(int, axis);
  QFETCH(double, spacing);
  QFETCH(double, sigma);
  QFETCH(bool, lives);
  VoxelGeometry grid;
  grid.size = glm::ivec3(7);
  grid.size[axis] = 61;
  grid.patientFromVoxelStep[axis] *= spacing;
  const BitMask mask = maskWhere(grid, [&](glm::ivec3 v) { return std::abs(v[axis] - 30) <= 2; });
  QCOMPARE(!gaussianSmoothed(mask, sigma).empty(), lives);
}

void TestSmoothing::ballsShrinkByTheSquareOfSigma() {
  // Balls shrink by sigma^2 / r on every grid: 10 mm to 9.1 (a third term adds little), and in volume to
  // 0.74.
  for (const Grid& shape : grids) {
    VoxelGeometry grid = cube(1, shape.patientFromVoxelStep);
    const glm::dmat3 back = glm::transpose(grid.voxelFromPatientStep());
    for (int a = 0; a < 3; ++a) grid.size[a] = 2 * int(std::ceil(14 * glm::length(back[a]))) + 1;
    grid.origin = -(grid.patientFromVoxelStep * glm::dvec3(grid.size / 2));
    const BitMask ball = maskWhere(
        grid, [&](glm::ivec3 v) { return glm::length(grid.patientFromVoxel(glm::dvec3(v))) <= 10; });
    const double part = double(gaussianSmoothed(ball, 3).count()) / double(ball.count());
    QVERIFY2(std::abs(part - 0.74) < 0.04,
             qPrintable(QStringLiteral("%1: %2").arg(QLatin1String(shape.name)).arg(part)));
  }
}

void TestSmoothing::labelsLeaveNoGap() {
  const LabelMap map = labelsOf(cube(24), [](glm::ivec3 v) {
    if (glm::length(glm::dvec3(v) - 11.5) > 9) return 0;
    return (v.x + v.y * 7 + v.z * 3) % 5 < 2 || v.x < 11 ? 1 : 2;
  });
  const LabelMap smoothed = jointSmoothed(map, 1.5);
  int gaps = 0;
  forVoxels(glm::ivec3(24),
            [&](glm::ivec3 v) { gaps += glm::length(glm::dvec3(v) - 11.5) < 6 && smoothed.at(v) == 0; });
  QCOMPARE(gaps, 0);
}

void TestSmoothing::ofTwoLabelsAlikeTheSmallerWins() {
  VoxelGeometry grid = cube(21);
  // About the middle both halves have equal shares. The middle's own label has one plane alone, and thus the
  // least.
  const auto halves = [&](int left, int right) {
    return labelsOf(grid, [=](glm::ivec3 v) { return v.x < 10 ? left : v.x > 10 ? right : 9; });
  };
  for (const auto& [left, right] : {std::pair(3, 5), std::pair(5, 3)}) {
    const LabelMap smoothed = jointSmoothed(halves(left, right), 3);
    QCOMPARE(int(smoothed.at({10, 10, 10})), 3);
    QCOMPARE(int(smoothed.at({9, 10, 10})), left);
    QCOMPARE(int(smoothed.at({11, 10, 10})), right);
  }
  // A voxel keeps its label if another has an equal share, as in alternating planes of two labels.
  const LabelMap turns = labelsOf(grid, [](glm::ivec3 v) { return v.y / 4 % 2 ? 5 : 3; });
  QVERIFY(jointSmoothed(turns, 0.6) == turns);
}

void TestSmoothing::lockedLabelsNeitherGainNorLose() {
  const LabelMap map =
      labelsOf(cube(16), [](glm::ivec3 v) { return (v.x * 5 + v.y * 3 + v.z * 7) % 11 % 4; });
  const std::uint8_t locked[] = {2, 3};
  const LabelMap smoothed = jointSmoothed(map, 1, locked);
  QVERIFY(smoothed != map);
  QVERIFY(maskOf(smoothed, 2) == maskOf(map, 2));
  QVERIFY(maskOf(smoothed, 3) == maskOf(map, 3));
}

void TestSmoothing::bricksThatStayAreShared() {
  VoxelGeometry grid = cube(32);
  grid.size.x = 128;
  // A ragged label is in the first brick, and an unchanged slab in the last.
  const LabelMap map = labelsOf(grid, [](glm::ivec3 v) {
    return v.x > 80 ? int(v.y < 16) : v.x > 5 && v.x < 20 ? (v.x + v.y + v.z) % 2 : 0;
  });
  const LabelMap smoothed = jointSmoothed(map, 1);
  QVERIFY(smoothed.brick(0) != map.brick(0));
  QVERIFY(map.brick(3).voxels && smoothed.brick(3).voxels == map.brick(3).voxels);
}

void TestSmoothing::theSameByOneThread() {
  Chance chance(3);
  VoxelGeometry grid = cube(50, grids[3].patientFromVoxelStep);
  grid.size.x = 150;
  const BitMask mask = anyMask(chance, grid);
  const LabelMap map = labelsOf(grid, [&](glm::ivec3 v) { return mask.at(v) ? 1 : chance.below(3); });
  const BitMask gaussian = gaussianSmoothed(mask, 0.8), median = medianSmoothed(mask, 2);
  const LabelMap joint = jointSmoothed(map, 0.8);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  QVERIFY(gaussianSmoothed(mask, 0.8) == gaussian);
  QVERIFY(medianSmoothed(mask, 2) == median);
  QVERIFY(jointSmoothed(map, 0.8) == joint);
}

void TestSmoothing::cancelledEndsSoon() {
  const VoxelGeometry grid = cube(200);
  const BitMask mask = maskWhere(grid, [](glm::ivec3 v) { return (v.x ^ v.y ^ v.z) & 1; });
  const CancelToken cancel;
  cancel.cancel();
  QElapsedTimer timer;
  timer.start();
  medianSmoothed(mask, 6, cancel);
  gaussianSmoothed(mask, 6, cancel);
  QVERIFY(timer.elapsed() < 1000);  // they take tens of seconds if not cancelled
}

VOLUMEN_TEST(TestSmoothing);
#include "tst_smoothing.moc"
