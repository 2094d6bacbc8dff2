// Lattices seen along directions of small integers. Plain steps could repeatedly meet their cells at the same
// few places.
#include <functional>
#include <glm/geometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_parts.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

/// Returns a lattice in 0 .. 1 with periods of 2 to 8 voxels.
std::function<double(dvec3 pVoxel)> anyLattice(Chance& chance) {
  ivec3 period, phase, along;
  for (int a = 0; a < 3; ++a)
    period[a] = 2 + chance.below(7), phase[a] = chance.below(8), along[a] = chance.below(3);
  switch (chance.below(6)) {
    case 0:  // points
      return [=](dvec3 x) { return (ivec3(x) + phase) % period == ivec3(0); };
    case 1:  // oblique layers with rising values
      return [=](dvec3 x) { return (int(x.x) + int(x.y) + int(x.z)) % period.x / double(period.x - 1); };
    case 3:
    case 4:
    case 5:  // oblique layers, columns in a checkerboard
      return [=](dvec3 x) {
        return glm::dot(x, dvec3(along)) - period.x * std::floor(glm::dot(x, dvec3(along)) / period.x) == 0;
      };
    case 2:  // checkerboard
      return [=](dvec3 x) {
        return (int(x.x) / (period.x - 1) + int(x.y) / (period.y - 1) + int(x.z) / (period.z - 1)) % 2;
      };
    default:  // plates
      return [=](dvec3 x) { return int(x[phase.x % 3]) % period.x == 0; };
  }
}

}  // namespace

dvec3 directionOfSmallNumbers(Chance& chance) {
  constexpr ivec3 kinds[] = {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 0}, {2, 2, 1}, {2, 1, 1},
                             {3, 2, 1}, {8, 4, 1}, {4, 7, 4}, {6, 3, 2}, {3, 4, 0}, {1, 2, 4}};
  ivec3 steps = chance.oneIn(3) ? ivec3(chance.below(9), chance.below(9), 1 + chance.below(8))
                                : kinds[chance.below(std::size(kinds))];
  for (int a = 2; a > 0; --a) std::swap(steps[a], steps[chance.below(a + 1)]);
  for (int a = 0; a < 3; ++a)
    if (chance.oneIn(2)) steps[a] = -steps[a];
  return glm::normalize(dvec3(steps));
}

RandomCase randomLattice(Chance& chance) {
  RandomCase c;
  c.what = "lattice";
  c.size = {24, 24};
  const int edge = 24 + 4 * chance.below(10);
  dmat3 steps(1);
  if (chance.oneIn(4))
    for (int a = 1; a < 3; ++a) steps[a][a] = 1 + chance.below(4);
  const auto share = anyLattice(chance);
  c.volume = volumeOf<std::int16_t>(ivec3(edge), steps, [&](dvec3 x) { return 1000 * share(x); });

  // The curve is about as steep as the limit for plain steps. `change` sets the change per voxel, and the
  // unit distance follows from it.
  TransferFunction& curve = c.scene.transferFunction;
  const bool whole = chance.oneIn(2);
  const double low = whole ? 0 : -1000 * chance.share(), high = whole ? 1000 : 1000 + 1000 * chance.share();
  const double opacity = chance.between(0.2, 0.9), change = chance.power(-1.3, 0.8);
  const bool white = chance.oneIn(2);
  curve.points = {{float(low), white ? dvec3(0) : chance.colour(), 0},
                  {float(high), white ? dvec3(1) : chance.colour(), opacity}};
  if (chance.oneIn(4)) std::swap(curve.points[0].opacity, curve.points[1].opacity);
  curve.unitDistance = opacity / (1 - opacity) * 1000 / (high - low) / change;

  addRandomLight(chance, c.scene, 2, 1);
  if (!chance.oneIn(4)) c.scene.shading.lit = false;
  Camera camera;
  camera.direction = directionOfSmallNumbers(chance);
  camera.up = chance.vector();
  camera = fitCamera(camera, c.volume->geometry(), 1);
  camera.height *= chance.between(0.1, 0.7);
  if (chance.oneIn(6)) {
    camera.projection = Projection::perspective;
    camera.fov = chance.between(5, 60);
  }
  *camera.target += chance.vector();
  c.scene.camera = camera;
  return c;
}

}  // namespace volumen::tests
