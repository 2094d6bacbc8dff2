// Guards slices.md 1 on random planes through random volumes, against a simple loop in double precision.
// Covers every stored type, geometry, interpolation and slab. VOLUMEN_RANDOM_CASES=N draws N seeds from
// VOLUMEN_RANDOM_SEED on.
#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/slice/slow_slice.h"
#include "tests/unit/suite.h"
#include "viewer/slice/slice.h"

using namespace volumen;
using namespace volumen::tests;

class TestRandomPlanes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void agreeWithASimpleLoop_data();
  void agreeWithASimpleLoop();
  void sameBytesOnEveryCpuAndAnyNumberOfThreads();
};

namespace {

glm::dmat3 rotation(Chance& chance) {
  const glm::dvec3 x = glm::normalize(chance.vector() + glm::dvec3(0, 0, 1e-9));
  const glm::dvec3 y = glm::normalize(glm::cross(x, chance.vector() + glm::dvec3(1e-9, 0, 0)));
  return {x, y, glm::cross(x, y)};
}

// Returns anisotropic steps that may be oblique, sheared or left-handed.
glm::dmat3 steps(Chance& chance) {
  glm::dmat3 L = chance.oneIn(3) ? glm::dmat3(1) : rotation(chance);
  for (int a = 0; a < 3; ++a) L[a] *= chance.power(-0.5, 0.7);
  if (chance.oneIn(3)) L[2] += L[1] * chance.between(-0.5, 0.5);
  if (chance.oneIn(3)) L[0] = -L[0];
  return L;
}

glm::ivec3 size(Chance& chance) {
  if (chance.oneIn(20)) return glm::ivec3(1);
  glm::ivec3 n(1 + chance.below(40), 1 + chance.below(30), 1 + chance.below(20));
  if (chance.oneIn(6)) n[chance.below(3)] = 1;
  return n;
}

template <class T>
VolumePtr volumeByChance(Chance& chance, double low, double high, double slope, double intercept) {
  const glm::dmat3 L = steps(chance);
  const glm::ivec3 n = size(chance);
  return volumeOf<T>(
      n, L, [&](glm::dvec3) { return chance.between(low, high); }, slope, intercept);
}

VolumePtr volumeByChance(Chance& chance) {
  switch (chance.below(5)) {
    case 0:
      return volumeByChance<std::uint8_t>(chance, 0, 256, 1, 0);
    case 1:
      return volumeByChance<std::int16_t>(chance, -32768, 32768, 1, -1024);
    case 2:
      return volumeByChance<std::uint16_t>(chance, 0, 65536, -0.25, 100);
    case 3:
      return volumeByChance<std::int16_t>(chance, 0, 4096, 0.37, 12.5);
    default:
      return volumeByChance<float>(chance, -1e4, 1e4, 1, 0);
  }
}

SlicePlane planeByChance(Chance& chance, const VoxelGeometry& g) {
  SlicePlane plane;
  const glm::dmat3 r = chance.oneIn(4) ? glm::dmat3(1) : rotation(chance);
  plane.right = r[chance.below(2)], plane.down = r[2];
  const glm::dvec3 s = g.spacing();
  plane.mmPerPixel = std::min({s.x, s.y, s.z}) * chance.power(-1, 0.6);
  plane.size = {1 + chance.below(150), 1 + chance.below(30)};
  const glm::dvec3 half = glm::dvec3(g.size) * 0.5;
  plane.centre = g.patientFromVoxel(half - 0.5 + chance.vector() * half);
  if (chance.oneIn(2)) plane.slabMm = voxelAlong(g, plane.normal()) * chance.between(0, 6);
  plane.slabMode = SlabMode(chance.below(3));
  plane.interpolation = Interpolation(chance.below(3));
  plane.average = chance.oneIn(3);
  return plane;
}

double largestOf(const Volume& volume) {
  double largest = 0;
  for (std::int64_t n = 0; n < volume.geometry().voxelCount(); ++n)
    largest = std::max(largest, std::abs(double(volume.valueAt(n))));
  return largest;
}

}  // namespace

void TestRandomPlanes::agreeWithASimpleLoop_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(300, 300);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// The bound is 1e-6 of the largest value. Floats resolve 6e-8 of it, of which a slice loses some, and
// positions of 2^-24 voxels add 3e-8 of a step.
void TestRandomPlanes::agreeWithASimpleLoop() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const VolumePtr volume = volumeByChance(chance);
  const SlicePlane plane = planeByChance(chance, volume->geometry());
  const SlowSlice truth = slowSlice(*volume, plane);
  const auto slice = resampleSlice(*volume, plane, 1 + chance.below(4));
  QVERIFY2(slice.ok(), slice.ok() ? "" : slice.message().c_str());
  QCOMPARE(slice->values.size(), truth.values.size());
  const double bound = 1e-6 * largestOf(*volume);
  for (std::size_t n = 0; n < truth.values.size(); ++n) {
    if (truth.doubtful[n]) continue;
    const double is = slice->values[n], should = truth.values[n];
    if (std::isnan(is) && std::isnan(should)) continue;
    QVERIFY2(std::abs(is - should) <= bound,
             qPrintable(QStringLiteral("pixel %1, %2: %3, not %4, off by %5 of the bound")
                            .arg(n % plane.size.x)
                            .arg(n / plane.size.x)
                            .arg(is)
                            .arg(should)
                            .arg(std::abs(is - should) / bound)));
  }
}

void TestRandomPlanes::sameBytesOnEveryCpuAndAnyNumberOfThreads() {
  const auto use = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  };
  for (int seed = 1; seed <= 40; ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VolumePtr volume = volumeByChance(chance);
    SlicePlane plane = planeByChance(chance, volume->geometry());
    plane.size = {333, 77};
    const auto first = resampleSlice(*volume, plane, 1);
    const auto same = [&](int threads) {
      const auto again = resampleSlice(*volume, plane, threads);
      return again->values.size() == first->values.size() &&
             std::memcmp(again->values.data(), first->values.data(), 4 * first->values.size()) == 0;
    };
    for (int threads : {0, 2, 3, 7}) QVERIFY2(same(threads), qPrintable(QString::number(seed)));
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
      use(left & -left);
      const bool are = same(2);
      use(0);
      QVERIFY2(are, qPrintable(QString::number(seed)));
    }
  }
}

VOLUMEN_TEST(TestRandomPlanes);
#include "tst_random_planes.moc"
