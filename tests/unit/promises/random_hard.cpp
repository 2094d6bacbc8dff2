// The family "hard": tiny volumes at the limits of numerical range.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_parts.h"
#include "viewer/volume/histogram.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

constexpr const char* patterns[] = {"ball", "noise", "plates", "stripes", "zigzag", "ramp", "constant"};

/// Returns the pattern's value at x, 0 .. 1.
double patternAt(Chance& chance, const std::string& pattern, int period, dvec3 x, ivec3 size) {
  if (pattern == "ball") {
    const double radius = 0.3 * std::max({size.x, size.y, size.z});
    return std::erfc((glm::distance(x, dvec3(size - 1) * 0.47) - radius) / 0.85) / 2;
  }
  if (pattern == "noise") return chance.share();
  if (pattern == "plates") return int(x.z) % period == 0;
  if (pattern == "stripes") return int(x.y) % period == 0 && int(x.x) % 2 == 0;
  if (pattern == "zigzag") return std::abs(std::remainder(x.x + 0.5 * x.y, 2 * period)) / period;
  if (pattern == "ramp") return glm::dot(x, dvec3(0.5, 0.3, 0.2)) / std::max({size.x, size.y, size.z});
  return 0.5;
}

dmat3 randomGrid(Chance& chance) {
  dmat3 steps(1);
  const int kind = chance.below(6);
  const double wide = kind == 3 ? 1.5 : 0.5;  // decimal exponent of the spacings
  if (kind >= 2 && kind < 5)
    for (int a = 0; a < 3; ++a) steps[a][a] = chance.power(-wide, wide);
  if (kind == 4) steps[0][0] *= -1;
  if (kind == 5) {
    do
      for (int a = 0; a < 3; ++a) steps[a] = chance.vector() * 1.5;
    while (std::abs(glm::determinant(steps)) < 0.1);
  }
  return chance.oneIn(4) ? chance.power(-3, 4) * steps : steps;
}

/// Returns a volume whose stored numbers `low` .. `high` mean values from `offset` on over `range`.
template <class T>
VolumePtr storedAs(ivec3 size, const dmat3& grid, double low, double high, double range, double offset,
                   const std::function<double(dvec3)>& shareAt) {
  const double slope = range / (high - low);
  return volumeOf<T>(
      size, grid, [&](dvec3 x) { return std::round(low + shareAt(x) * (high - low)); }, slope,
      offset - low * slope);
}

VolumePtr randomVolume(Chance& chance, std::string& what) {
  ivec3 size;
  for (int a = 0; a < 3; ++a) size[a] = chance.oneIn(8) ? 1 : 1 + chance.below(24);
  const dmat3 grid = randomGrid(chance);
  what = patterns[chance.below(std::size(patterns))];
  const int period = 2 + chance.below(5);
  const double range = chance.oneIn(3) ? chance.power(-30, 30) : chance.power(0, 3.5);
  const double far = chance.oneIn(6) && range < 1e24 ? 1e5 * range : 0;
  const double offset = chance.oneIn(2) ? far : -far;
  const auto shareAt = [&](dvec3 x) { return patternAt(chance, what, period, x, size); };
  switch (chance.below(6)) {
    case 0:
      return storedAs<std::uint8_t>(size, grid, 0, 255, range, offset, shareAt);
    case 1:
      return storedAs<std::int16_t>(size, grid, -32768, 32767, range, offset, shareAt);
    case 2:
      return storedAs<std::uint16_t>(size, grid, 0, 4095, range, offset, shareAt);
    default:
      return volumeOf(size, grid, [&](dvec3 x) { return offset + range * shareAt(x); });
  }
}

double randomOpacity(Chance& chance) {
  switch (chance.below(8)) {
    case 0:
      return 1;
    case 1:
      return chance.power(-7, 0);
    case 2:
      return 1 - chance.power(-7, -1);
    case 3:
    case 4:
      return 0;
    default:
      return std::pow(chance.share(), 2);
  }
}

/// Returns up to 256 points. A third of them lie on values of voxels, where plateaus are.
std::vector<CurvePoint> randomCurve(Chance& chance, const Volume& volume, ValueRange range) {
  std::vector<CurvePoint> points(chance.oneIn(4) ? std::size_t(1) << (3 + chance.below(6))
                                                 : std::size_t(1 + chance.below(7)));
  for (CurvePoint& p : points) {
    const bool onVoxel = chance.oneIn(3);
    p.value = onVoxel ? valueOfAnyVoxel(chance, volume) : valueIn(range, chance.between(-0.1, 1.1));
    p.colour = chance.colour();
    p.opacity = randomOpacity(chance);
  }
  std::sort(points.begin(), points.end(),
            [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
  return points;
}

double randomUnitDistance(Chance& chance, double voxelMm) {
  if (chance.oneIn(20)) return 1e-40;
  return chance.oneIn(3) ? chance.power(-3, 3) : voxelMm * chance.power(-1, 1);
}

void addExtremes(Chance& chance, Scene& scene, double perMm) {
  scene.shading.shininess = chance.oneIn(4) ? 10000 : chance.power(0, 4);
  if (chance.oneIn(3)) scene.shading.gradientFloor = perMm * chance.power(-8, 6);
  if (chance.oneIn(4)) scene.transferFunction.gradientOpacity = randomGradientOpacity(chance, perMm);
  if (chance.oneIn(6)) scene.camera->height *= chance.power(-4, 0);
  if (chance.oneIn(6)) scene.camera->fov = chance.power(-1, 2.1);
}

}  // namespace

RandomCase randomHard(Chance chance) {
  RandomCase c;
  c.volume = randomVolume(chance, c.what);
  const VoxelGeometry& g = c.volume->geometry();
  const ValueRange range = valueRange(*c.volume);
  const double spread = range.high > range.low ? range.high - range.low : 1;
  Scene& scene = c.scene;
  scene.mode = randomMode(chance);
  scene.window = windowAbout(chance, scene.mode, range, spread * chance.power(-1, 0.3));
  scene.transferFunction.points = randomCurve(chance, *c.volume, range);
  scene.transferFunction.unitDistance = randomUnitDistance(chance, voxelEdgeOf(g));
  addRandomLight(chance, scene, 6, chance.oneIn(3) ? 20 : 1);
  scene.camera = randomCamera(chance, g);
  addExtremes(chance, scene, spread / voxelEdgeOf(g));
  scene.clip = randomClip(chance, g);
  scene.background = randomBackground(chance);
  c.size = randomPictureSize(chance);
  return c;
}

}  // namespace volumen::tests
