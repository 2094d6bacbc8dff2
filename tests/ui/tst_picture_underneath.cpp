// Guards that what is kept of a slice under tints and segments is what would be drawn anew, whatever a
// request changes from the last one, and that it keeps no volume.
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/controller/picture_underneath.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr glm::ivec3 rampSize{40, 37, 35};  // more than one brick of labels along each axis

VolumePtr shearedRamp(double offset) {
  return volumeOf<std::int16_t>(rampSize, glm::dmat3(1.0, 0.1, 0, 0, 1.3, 0, 0, 0.2, 2.1),
                                [offset](glm::dvec3 p) { return offset + p.x * 7 + p.y * 3 - p.z * 5; });
}

std::shared_ptr<const LabelMap> chanceLabels(Chance& chance, const VoxelGeometry& grid) {
  LabelEdit edit{LabelMap(grid)};
  const glm::ivec3 low(chance.below(20), chance.below(20), chance.below(20));
  for (int n = chance.below(3000); n > 0; --n) {
    const glm::ivec3 at = low + glm::ivec3(chance.below(17), chance.below(17), chance.below(15));
    edit.set(at, std::uint8_t(1 + chance.below(3)));
  }
  return std::make_shared<const LabelMap>(edit.done());
}

SlicePlane chancePlane(Chance& chance) {
  SlicePlane plane;
  plane.centre = chance.vector() * 10.0;
  plane.right = glm::normalize(glm::dvec3(1, chance.between(-1, 1) * chance.below(2), 0));
  plane.down = glm::normalize(glm::cross(glm::dvec3(0, 0.3 * chance.below(2), 1), plane.right));
  plane.mmPerPixel = chance.between(0.4, 2);
  plane.size = {1 + chance.below(60), 1 + chance.below(60)};
  return plane;
}

SegmentLayer chanceSegments(Chance& chance, const VoxelGeometry& grid) {
  SegmentLayer layer;
  layer.labels = chanceLabels(chance, grid);
  for (const std::size_t label : {3u, 1u})
    layer.shown.push_back({label, qRgb(200, 20 * int(label), 90), 0.7});
  layer.opacity = chance.share();
  return layer;
}

SliceLayer plainLayer(VolumePtr volume, double opacity = 1) {
  SliceLayer layer;
  layer.volume = std::move(volume);
  layer.opacity = opacity;
  return layer;
}

SliceRequest requestUnder(VolumePtr volume, Chance& chance) {
  SliceRequest request;
  request.layers.push_back(plainLayer(std::move(volume)));
  request.plane = chancePlane(chance);
  return request;
}

// One part of the request changes.
void changePart(SliceRequest& request, Chance& chance, const std::vector<VolumePtr>& volumes) {
  switch (chance.below(6)) {
    case 0:
      request.plane = chancePlane(chance);
      break;
    case 1:
      request.layers.front().volume = volumes[std::size_t(chance.below(2))];
      break;
    case 2:
      request.layers.resize(1);
      if (chance.oneIn(2)) request.layers.push_back(plainLayer(volumes[1], 0.4));
      break;
    case 3:
      std::erase_if(request.layers, [](const SliceLayer& layer) { return layer.tinted.has_value(); });
      if (chance.oneIn(2)) {
        request.layers.push_back(plainLayer(volumes[0], 0.5));
        request.layers.back().tinted = TintedRange{{chance.between(-100, 100), 200}, qRgb(255, 80, 0)};
      }
      break;
    default:
      request.segments.clear();
      if (chance.oneIn(3)) return;
      request.segments.push_back(chanceSegments(chance, volumes[0]->geometry()));
  }
}

}  // namespace

class TestPictureUnderneath : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void keptOrDrawnAnewItIsTheSame();
  void aVolumeIsLetGo();
};

void TestPictureUnderneath::keptOrDrawnAnewItIsTheSame() {
  const std::vector<VolumePtr> volumes{shearedRamp(0), shearedRamp(60)};
  const Seeds seeds = seedsOf(5, 100);
  int kept = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    PictureUnderneath underneath;
    SliceRequest request = requestUnder(volumes[0], chance);
    const void* last = nullptr;
    for (int n = 0; n < 40; ++n) {
      changePart(request, chance, volumes);
      const Result<QImage> picture = underneath.of(request), anew = drawUnderneath(request);
      QVERIFY(picture && anew);
      QVERIFY2(*picture == *anew, qPrintable(QStringLiteral("seed %1, change %2").arg(seed).arg(n)));
      kept += std::exchange(last, picture->constBits()) == picture->constBits() ? 1 : 0;
    }
  }
  QVERIFY(kept > 20);  // not all are drawn anew
}

void TestPictureUnderneath::aVolumeIsLetGo() {
  VolumePtr volume = shearedRamp(0);
  const std::weak_ptr<const Volume> left = volume;
  PictureUnderneath underneath;
  Chance chance{1};
  QVERIFY(underneath.of(requestUnder(std::exchange(volume, nullptr), chance)));
  QVERIFY(left.expired());
}

VOLUMEN_TEST(TestPictureUnderneath);
#include "tst_picture_underneath.moc"
