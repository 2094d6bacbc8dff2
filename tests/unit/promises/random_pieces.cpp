// The family "pieces": boxes of the real test data in typical scenes.
#include <algorithm>
#include <map>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/level_scenes.h"
#include "tests/unit/promises/random_parts.h"
#include "viewer/volume/histogram.h"

namespace volumen::tests {
namespace {

using glm::dvec3;
using glm::ivec3;

/// Studies that most pieces are cut from, and the other ones.
constexpr const char* studies[] = {"ct-chest-lidc0314-138", "mr-head-siemens-gap-175",
                                   "mr-head-ge-mprage-130", "pet-ct/sts019-ct", "pet-ct/sts019-pet"};
constexpr const char* others[] = {"volumes-classic/fuel.mha",
                                  "volumes-classic/neghip.mha",
                                  "volumes-classic/nucleon.mha",
                                  "volumes-classic/silicium.mha",
                                  "volumes-classic/headsq-quarter/quarter.nhdr",
                                  "nrrd-medical/avf_float_32.nrrd",
                                  "nrrd-medical/slicer-BaselineVolume.nrrd",
                                  "nifti-meta/HeadMRVolume.mhd",
                                  "nifti-meta/i2nii-mha.mha",
                                  "nifti-meta/nibabel/anatomical.nii",
                                  "nifti-meta/niivue/shear.nii.gz"};

double spread(ValueRange range) { return range.high - range.low; }

ValueRange rangeOfStudy(const std::string& name) {
  static std::map<std::string, ValueRange> ranges;
  const auto [entry, isNew] = ranges.try_emplace(name);
  if (isNew) entry->second = valueRange(*levelVolume(name));
  return entry->second;
}

/// Returns every stride-th voxel from `low` on, at its position in patient space.
VolumePtr pieceOf(const Volume& whole, ivec3 low, ivec3 size, ivec3 stride) {
  VolumeParts parts;
  parts.geometry = whole.geometry();
  parts.geometry.size = size;
  parts.geometry.origin = whole.geometry().patientFromVoxel(dvec3(low));
  for (int a = 0; a < 3; ++a) parts.geometry.patientFromVoxelStep[a] *= stride[a];
  parts.slope = whole.slope();
  parts.intercept = whole.intercept();
  parts.attributes = whole.attributes();
  parts.values = std::visit(
      [&](const auto& all) -> VoxelValues {
        std::decay_t<decltype(all)> values;
        for (int k = 0; k < size.z; ++k)
          for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
              const ivec3 x = low + stride * ivec3(i, j, k);
              values.push_back(all[(std::size_t(x.z) * whole.size().y + x.y) * whole.size().x + x.x]);
            }
        return values;
      },
      whole.stored());
  return volumeFrom(std::move(parts));
}

VolumePtr anyPieceOf(Chance& chance, const Volume& whole) {
  ivec3 low, size, stride;
  const bool everyVoxel = chance.oneIn(2);
  for (int a = 0; a < 3; ++a) {
    const int edge = whole.size()[a];
    stride[a] = everyVoxel || edge < 24 ? 1 : 1 + chance.below(3);
    size[a] = std::min(8 + chance.below(33), edge / stride[a]);
    low[a] = chance.below(edge - stride[a] * (size[a] - 1));
  }
  return pieceOf(whole, low, size, stride);
}

/// Tries up to ten pieces until one has differing values, as air alone is rarely drawn.
VolumePtr pieceWithSomethingIn(Chance& chance, const std::string& name) {
  const Volume& whole = *levelVolume(name);
  VolumePtr piece;
  for (int tries = 0; tries < 10; ++tries) {
    piece = anyPieceOf(chance, whole);
    if (spread(valueRange(*piece)) > 0.05 * spread(rangeOfStudy(name))) break;
  }
  return piece;
}

double randomOpacity(Chance& chance) {
  if (chance.oneIn(12)) return 1;
  return chance.oneIn(3) ? 0 : std::pow(chance.share(), 2);
}

/// Returns a value anywhere in the range, or of a random voxel.
float randomValue(Chance& chance, const Volume& volume, ValueRange range) {
  return chance.oneIn(2) ? valueIn(range, chance.share()) : valueOfAnyVoxel(chance, volume);
}

std::vector<CurvePoint> ordinaryCurve(Chance& chance, const Volume& volume, ValueRange range) {
  std::vector<CurvePoint> points(std::size_t(1 + chance.below(7)));
  for (CurvePoint& p : points)
    p = {randomValue(chance, volume, range), chance.colour(), randomOpacity(chance)};
  std::sort(points.begin(), points.end(),
            [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
  return points;
}

/// Returns a ramp from transparent to a surface over 0.3 to 10 % of the range.
std::vector<CurvePoint> sharpRamp(Chance& chance, const Volume& volume, ValueRange range) {
  const double start = randomValue(chance, volume, range), wide = spread(range) * chance.power(-2.5, -1);
  const double opacity = chance.oneIn(2) ? 1 : chance.between(0.1, 1);
  const dvec3 colour = chance.colour();
  return {{float(start), colour, 0}, {float(start + wide), colour, opacity}};
}

/// Returns a sharp ramp between two colours and a third colour above it.
std::vector<CurvePoint> colouredRamp(Chance& chance, const Volume& volume, ValueRange range) {
  std::vector<CurvePoint> points = sharpRamp(chance, volume, range);
  const double wide = double(points[1].value) - double(points[0].value);
  points[1].colour = chance.colour();
  points.push_back(
      {float(double(points[1].value) + chance.between(1, 3) * wide), chance.colour(), points[1].opacity});
  return points;
}

std::vector<CurvePoint> steppedCurve(Chance& chance, ValueRange range) {
  std::vector<CurvePoint> points;
  double opacity = 0;
  for (double share : randomShares(chance, 1 + chance.below(3))) {
    points.push_back({valueIn(range, share), chance.colour(), opacity});
    points.push_back({valueIn(range, share), chance.colour(), opacity = randomOpacity(chance)});
  }
  return points;
}

std::vector<CurvePoint> randomCurve(Chance& chance, const Volume& volume, ValueRange range) {
  const int kind = chance.below(16);
  if (kind < 8) return ordinaryCurve(chance, volume, range);
  if (kind < 11) return sharpRamp(chance, volume, range);
  return kind < 14 ? colouredRamp(chance, volume, range) : steppedCurve(chance, range);
}

Window randomWindow(Chance& chance, const Volume& volume, Mode mode) {
  constexpr Window usual[] = {{40, 400}, {-600, 1500}, {300, 1500}, {50, 150}};
  if (volume.attributes().modality == "CT" && chance.oneIn(3)) return usual[chance.below(4)];
  const std::vector<float> ends = percentiles(volume, {10, 990});
  const ValueRange range{ends[0], ends[1]};
  const double share = chance.oneIn(3) ? chance.between(0.1, 0.3) : chance.between(0.3, 1.2);
  return windowAbout(chance, mode, range, spread(range) > 0 ? share * spread(range) : 1);
}

}  // namespace

RandomCase randomPiece(Chance chance) {
  const std::string name =
      chance.oneIn(3) ? others[chance.below(std::size(others))] : studies[chance.below(std::size(studies))];
  RandomCase c;
  c.what = name;
  if (!levelVolume(name)) return c;
  c.volume = pieceWithSomethingIn(chance, name);
  const VoxelGeometry& g = c.volume->geometry();
  const ValueRange range = valueRange(*c.volume);
  Scene& scene = c.scene;
  scene.mode = randomMode(chance);
  scene.window = randomWindow(chance, *c.volume, scene.mode);
  scene.transferFunction.points = randomCurve(chance, *c.volume, range);
  scene.transferFunction.unitDistance = chance.oneIn(2) ? 1 : voxelEdgeOf(g) * chance.power(-0.7, 0.7);
  if (chance.oneIn(4) && spread(range) > 0)
    scene.transferFunction.gradientOpacity =
        randomGradientOpacity(chance, 0.3 * spread(range) / voxelEdgeOf(g));
  addRandomLight(chance, scene, 4, chance.oneIn(5) ? 3 : 1);
  scene.shading.shininess = chance.power(0, 3);
  scene.camera = randomCamera(chance, g);
  scene.clip = randomClip(chance, g);
  scene.background = randomBackground(chance);
  c.size = randomPictureSize(chance);
  return c;
}

}  // namespace volumen::tests
