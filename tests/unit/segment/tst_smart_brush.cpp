// Guards smart_brush.h: mean and standard deviation under a brush, and the part of it connected to a voxel,
// against a flood fill.
#include <cmath>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/smart_brush.h"

using namespace volumen;
using namespace volumen::tests;

class TestSmartBrush : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theRangeIsMeanAndDeviations();
  void paddingIsNoValue();
  void connectedAsByAFlood();
};

namespace {

VoxelSpans spansOf(const BitMask& mask) {
  VoxelSpans spans;
  for (const glm::ivec3 v : voxelsOf(mask.geometry())) {
    if (!mask.at(v)) continue;
    if (!spans.empty() && spans.back().end == v.x && spans.back().j == v.y && spans.back().k == v.z)
      ++spans.back().end;
    else
      spans.push_back({v.x, v.x + 1, v.y, v.z});
  }
  return spans;
}

}  // namespace

void TestSmartBrush::theRangeIsMeanAndDeviations() {
  // 2, 4, 4, 4, 5, 5, 7, 9: mean 5, SD 2.
  const double values[] = {2, 4, 4, 4, 5, 5, 7, 9};
  const VolumePtr volume =
      volumeOf<float>({8, 1, 1}, glm::dmat3(1), [&](glm::dvec3 v) { return values[int(v.x)]; });
  const auto range = valuesUnder({{0, 8, 0, 0}}, *volume, 2.5);
  QVERIFY(range && std::abs(range->low) < 1e-12 && std::abs(range->high - 10) < 1e-12);
  QVERIFY(valuesUnder({{1, 4, 0, 0}}, *volume, 2.5) == (ValueRange{4, 4}));
  QVERIFY(!valuesUnder({}, *volume, 2.5));
  // Equal values that are no binary fraction give a range of exactly that value.
  const VolumePtr tenths = volumeOf<float>({8, 1, 1}, glm::dmat3(1), [](glm::dvec3) { return 0.1; });
  QVERIFY(valuesUnder({{0, 7, 0, 0}}, *tenths, 2.5) == (ValueRange{double(0.1f), double(0.1f)}));
}

void TestSmartBrush::paddingIsNoValue() {
  const VolumePtr made =
      volumeOf<std::int16_t>({4, 1, 1}, glm::dmat3(1), [](glm::dvec3 v) { return v.x < 2 ? -2000 : 50; });
  VolumeParts parts{made->geometry(), made->stored(), 1, 0, {}};
  parts.attributes.padding = ValueRange{-2000, -2000};
  const VolumePtr volume = volumeFrom(std::move(parts));
  QVERIFY(valuesUnder({{0, 4, 0, 0}}, *volume, 2.5) == (ValueRange{50, 50}));
  QVERIFY(!valuesUnder({{0, 2, 0, 0}}, *volume, 2.5));
  QVERIFY(connectedUnder({{0, 4, 0, 0}}, *volume, {-3000, 100}, {3, 0, 0}) == (VoxelSpans{{2, 4, 0, 0}}));
}

void TestSmartBrush::connectedAsByAFlood() {
  const Seeds seeds = seedsOf(500, 20000);
  int found = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {30, 9, 7});
    const VolumePtr volume = volumeOf<std::int16_t>(grid.size, grid.patientFromVoxelStep,
                                                    [&](glm::dvec3) { return int(random()) % 6; });
    const BitMask mask = anyMask(random, volume->geometry());
    const ValueRange range{double(random() % 3), double(2 + random() % 4)};
    const auto any = [&](int size) {
      return int(random() % unsigned(size + 2)) - 1;
    };  // includes voxels beyond the grid
    const glm::ivec3 voxel(any(grid.size.x), any(grid.size.y), any(grid.size.z));
    BitMask there(volume->geometry());
    for (const glm::ivec3 v : voxelsOf(grid))
      there.set(v, mask.at(v) && volume->value(v.x, v.y, v.z) >= range.low &&
                       volume->value(v.x, v.y, v.z) <= range.high);
    const VoxelSpans made = connectedUnder(spansOf(mask), *volume, range, voxel);
    QVERIFY2(made == spansOf(reachedFrom({voxel}, there, stepsAcross(-1))), caseOf(seed, mask).c_str());
    found += made.empty() ? 0 : 1;
  }
  QVERIFY(found > seeds.count / 100);
}

VOLUMEN_TEST(TestSmartBrush);
#include "tst_smart_brush.moc"
