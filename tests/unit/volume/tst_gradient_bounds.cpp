// Guards the planner's bounds on gradients: they hold in every cell and do not exceed those of a block.
#include <algorithm>
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/volume/gradient_bounds.h"
#include "viewer/volume/histogram.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

std::vector<float> gradientBoundsOf(const Volume& v) {
  return volumen::gradientBoundsOf(v, blockRanges(v), valueRange(v));
}

// Facts of a cell's corners, x fastest: lowest and highest value, and a bound on the gradient between them.
struct CellFacts {
  double low, high, slope;
};
CellFacts factsOf(const std::array<double, 8>& corner) {
  double most[3] = {};
  for (int n = 0; n < 8; ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (!(n >> axis & 1)) most[axis] = std::max(most[axis], std::abs(corner[n | 1 << axis] - corner[n]));
  const auto [low, high] = std::minmax_element(corner.begin(), corner.end());
  return {*low, *high, std::hypot(most[0], most[1], most[2])};
}

std::array<double, 8> cornersOf(const Volume& v, glm::ivec3 cell) {
  std::array<double, 8> corner;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 p = glm::min(cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2), v.size() - 1);
    corner[n] = v.realValue((std::size_t(p.z) * v.size().y + p.y) * v.size().x + p.x);
  }
  return corner;
}

VolumePtr madeOf(glm::ivec3 size, double (*valueAt)(glm::dvec3)) {
  return volumeOf(size, glm::dmat3(1), valueAt);
}

}  // namespace

class TestGradientBounds : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyCellIsBounded_data();
  void everyCellIsBounded();
  void aRampRisesByItsSlopeEverywhere();
  void oneStepIsSteepWhereItsBlockHasValues();
  void nothingRisesInAConstant();
};

void TestGradientBounds::everyCellIsBounded_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::newRow("bytes") << randomVolume<std::uint8_t>({13, 9, 7}, 0, 255);
  QTest::newRow("16 bits, all of them, negative slope")
      << randomVolume<std::int16_t>({9, 11, 6}, -32768, 32767, -0.5, 7);
  QTest::newRow("unsigned 16 bits") << randomVolume<std::uint16_t>({5, 4, 8}, 0, 65535, 2, -1024);
  QTest::newRow("floats of 1e30") << randomVolume<float>({6, 5, 4}, -1e30, 1e30);
  QTest::newRow("one slice") << randomVolume<std::int16_t>({10, 6, 1}, 0, 1000);
  QTest::newRow("one row") << randomVolume<std::int16_t>({10, 1, 1}, 0, 1000);
  QTest::newRow("one column") << randomVolume<std::int16_t>({1, 10, 1}, 0, 1000);
  QTest::newRow("one voxel") << randomVolume<std::int16_t>({1, 1, 1}, 0, 1000);
}

void TestGradientBounds::everyCellIsBounded() {
  QFETCH(VolumePtr, volume);
  const ValueRange range = valueRange(*volume);
  const std::vector<float> slopes = gradientBoundsOf(*volume);
  const glm::ivec3 size = volume->size();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const CellFacts cell = ::factsOf(cornersOf(*volume, {i, j, k}));
        for (std::size_t n = gradientBoundEntry(cell.low, range); n <= gradientBoundEntry(cell.high, range);
             ++n)
          QVERIFY(slopes[n] >= cell.slope * (1 - 1e-6));
      }
}

void TestGradientBounds::aRampRisesByItsSlopeEverywhere() {
  const VolumePtr ramp = madeOf({21, 10, 9}, [](glm::dvec3 p) { return 3 * p.x - 4 * p.z; });
  for (float slope : gradientBoundsOf(*ramp))
    QVERIFY(slope == 5 || slope == 0);  // some entries hold no value
  QCOMPARE(gradientBoundsOf(*ramp).front(), 5.0f);
}

void TestGradientBounds::oneStepIsSteepWhereItsBlockHasValues() {
  // Values rise by 1 a voxel, and by 100 between voxels 21 and 22.
  const auto at = [](glm::dvec3 p) { return p.x + (p.x > 21 ? 99.0 : 0.0); };
  // Blocks have one cell, or four: from 20 to 24.
  for (const glm::ivec3 size : {glm::ivec3(40, 5, 5), glm::ivec3(40, 90, 90)}) {
    const VolumePtr step = madeOf(size, at);
    const ValueRange range = valueRange(*step);
    const std::vector<float> slopes = gradientBoundsOf(*step);
    QCOMPARE(slopes[gradientBoundEntry(70, range)], 100.0f);
    QCOMPARE(slopes[gradientBoundEntry(21.6, range)], 100.0f);
    QCOMPARE(slopes[gradientBoundEntry(20.2, range)], size.y < 90 ? 1.0f : 100.0f);
    QCOMPARE(slopes[gradientBoundEntry(18, range)], 1.0f);
    QCOMPARE(slopes[gradientBoundEntry(130, range)], 1.0f);
  }
}

void TestGradientBounds::nothingRisesInAConstant() {
  const VolumePtr flat = madeOf({9, 9, 9}, [](glm::dvec3) { return 7.0; });
  QCOMPARE(gradientBoundsOf(*flat), std::vector<float>(256, 0.0f));
}

VOLUMEN_TEST(TestGradientBounds);
#include "tst_gradient_bounds.moc"
