// Guards masking by segments: the voxels are those whose distance to a segment is within the margin, on grids
// of every kind. Shown voxels of a volume keep their values, all others are air.
#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/mask.h"
#include "viewer/segment/tissue_shown.h"

using namespace volumen;
using namespace volumen::tests;

class TestTissueShown : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theVoxelsAreThoseOfTheDistances();
  void withoutSegmentsNothingIsInside();
  void whatIsLeftKeepsItsValues();
  void cancelledIsToldSo();
};

namespace {

using Where = TissueShown::Where;

LabelMap anySegments(std::mt19937& random, const VoxelGeometry& grid) {
  LabelMap labels(grid);
  for (const int label : {1, 7, 255}) labels = withLabel(labels, std::uint8_t(label), anyMask(random, grid));
  return labels;
}

// Tests the distances from a voxel to every other.
bool isNearSegments(const LabelMap& labels, const std::vector<int>& segments, double marginMm, glm::ivec3 a) {
  const VoxelGeometry& grid = labels.geometry();
  return std::ranges::any_of(voxelsOf(grid), [&](glm::ivec3 b) {
    const double mm = glm::length(grid.patientFromVoxelStep * glm::dvec3(b - a));
    return mm <= marginMm * (1 + 1e-9) && std::ranges::find(segments, int(labels.at(b))) != segments.end();
  });
}

}  // namespace

void TestTissueShown::theVoxelsAreThoseOfTheDistances() {
  const Seeds seeds = seedsOf(150, 1500);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {20, 7, 5});
    std::vector<ChosenSegments> maps(1 + random() % 3);
    for (ChosenSegments& map : maps) {
      map.labels = std::make_shared<const LabelMap>(anySegments(random, grid));
      for (const int label : {1, 7, 9, 255})
        if (random() % 2) map.numbers.push_back(label);
    }
    const double marginMm = random() % 3 == 0 ? 0 : double(random() % 500) / 100;
    const auto isNear = [&](glm::ivec3 v) {
      return std::ranges::any_of(maps, [&](const ChosenSegments& map) {
        return isNearSegments(*map.labels, map.numbers, marginMm, v);
      });
    };
    const BitMask inside = tissueVoxels(maps, {Where::inside, marginMm});
    QVERIFY2(isExactly(inside, isNear), caseOf(seed, inside).c_str());
    QVERIFY2(tissueVoxels(maps, {Where::outside, marginMm}) == inverted(inside),
             caseOf(seed, inside).c_str());
    QCOMPARE(tissueVoxels(maps, {Where::everywhere, marginMm}).count(), grid.voxelCount());
  }
}

void TestTissueShown::withoutSegmentsNothingIsInside() {
  const auto labels = std::make_shared<const LabelMap>(VoxelGeometry{.size = {70, 3, 2}});
  std::vector<ChosenSegments> maps{{labels, {}}, {labels, {}}};
  QVERIFY(tissueVoxels(maps, {Where::inside, 5}).empty());
  QCOMPARE(tissueVoxels(maps, {Where::outside, 5}).count(), std::int64_t(70 * 3 * 2));
  maps.back().numbers = {1};
  QVERIFY2(tissueVoxels(maps, {Where::inside, 5}).empty(), "a segment without voxels");
}

void TestTissueShown::whatIsLeftKeepsItsValues() {
  std::mt19937 random{1};
  const VolumePtr volume = randomVolume<std::int16_t>({67, 5, 4}, -1100, 300);
  const BitMask kept = anyMask(random, volume->geometry());
  const Result<VolumePtr> left = keptAlone(*volume, kept);
  QVERIFY(left.ok());
  for (const glm::ivec3 v : voxelsOf(volume->geometry()))
    QCOMPARE((*left)->value(v.x, v.y, v.z), kept.at(v) ? volume->value(v.x, v.y, v.z) : -1000.0f);
  QVERIFY((*left)->geometry() == volume->geometry());
  QVERIFY((*left)->attributes().cut == volume->attributes().cut);
}

void TestTissueShown::cancelledIsToldSo() {
  const CancelToken cancel;
  cancel.cancel();
  const VolumePtr volume = randomVolume<float>({4, 4, 4}, 0, 1);
  const std::string said = keptAlone(*volume, BitMask(volume->geometry()), cancel).message();
  QVERIFY2(said.find("cancelled") != std::string::npos, said.c_str());
}

VOLUMEN_TEST(TestTissueShown);
#include "tst_tissue_shown.moc"
