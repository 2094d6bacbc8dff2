// Kinds of the family "hostile": pilots' blind spots, large pictures whose error is in a small part.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_hostile.h"

namespace volumen::tests::hostile {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using glm::ivec3;

/// A share 0 .. 1 at a position in the picture, which is -0.5 .. 0.5 in both directions.
using ShareAt = std::function<double(dvec2 place)>;

/// A grid of 1 mm and a parallel view of it. The values of its voxels depend on where they are in the
/// picture.
struct Sight {
  VoxelGeometry geometry;
  Camera camera;
  CameraAxes axes;

  Sight(Chance& chance, int least, int most) {
    geometry.size = anySize(chance, least, most);
    geometry.origin = -(dvec3(geometry.size) - 1.0) / 2.0;
    camera.direction = nearly(chance, anyDirection(chance));
    camera.up = chance.vector();
    camera = fitCamera(camera, geometry, 1);
    camera.height *= chance.between(0.5, 0.9);
    axes = cameraAxes(camera);
  }
  dvec3 fromCentre(dvec3 pVoxel) const { return pVoxel + geometry.origin; }
  dvec2 placeOf(dvec3 pVoxel) const {
    const dvec3 p = fromCentre(pVoxel);
    return dvec2(glm::dot(p, axes.right), glm::dot(p, axes.up)) / camera.height;
  }
  /// The edge of a voxel in the picture.
  double voxel() const { return 1 / camera.height; }
};

/// Returns 1 inside a border at distance 0 and 0 outside, over one voxel.
double within(double distance, double voxel) { return std::clamp(0.5 - distance / voxel, 0.0, 1.0); }

ShareAt disc(Chance& chance, double share, double voxel) {
  const dvec2 centre(chance.between(-0.4, 0.4), chance.between(-0.4, 0.4));
  const double radius = std::sqrt(share / M_PI);
  return [=](dvec2 p) { return within(glm::distance(p, centre) - radius, voxel); };
}

ShareAt strip(Chance& chance, double share, double voxel) {
  const double turn = chance.oneIn(2) ? M_PI / 2 * chance.below(2) : chance.between(0, M_PI);
  const dvec2 normal(std::cos(turn), std::sin(turn));
  const double centre = chance.between(-0.4, 0.4);
  return [=](dvec2 p) { return within(std::abs(glm::dot(p, normal) - centre) - share / 2, voxel); };
}

ShareAt ring(Chance& chance, double share, double voxel) {
  const double radius = chance.between(0.1, 0.4), wide = share / (2 * M_PI * radius);
  return [=](dvec2 p) { return within(std::abs(glm::length(p) - radius) - wide / 2, voxel); };
}

/// Returns squares in even rows and columns, which regular tiles may all miss.
ShareAt squares(Chance& chance, double share, double voxel) {
  const int count = 2 << chance.below(3);
  const double edge = std::sqrt(share) / count;
  const dvec2 shift(chance.share(), chance.share());
  return [=](dvec2 p) {
    const dvec2 q = p * double(count) + shift;
    const double u = std::abs(std::remainder(q.x, 1)) / count, v = std::abs(std::remainder(q.y, 1)) / count;
    return within(std::max(u, v) - edge / 2, voxel);
  };
}

/// Returns a small part of the picture: a disc, a strip, a ring or squares of 0.05 to 5 % of its area.
ShareAt anyPart(Chance& chance, const Sight& sight) {
  const double share = chance.oneIn(2) ? chance.between(0.009, 0.03) : chance.power(-3.3, -1.3);
  switch (chance.below(5)) {
    case 0:
      return strip(chance, share, sight.voxel());
    case 1:
      return ring(chance, share, sight.voxel());
    case 2:
      return squares(chance, share, sight.voxel());
    default:
      return disc(chance, share, sight.voxel());
  }
}

/// Returns detail in 0 .. 1 for a comb of 60 points, whose phase plain steps do not see, or other detail.
ValueAt anyDetail(Chance& chance, const Sight& sight) {
  switch (chance.below(4)) {
    case 0:
      return noise(chance);
    case 1:
      return anyLattice(chance);
    case 2:
      return ripples(chance, chance.between(2, 8), 3);
    default: {
      const double cycles = (1 + chance.below(2)) / chance.between(0.13, 0.85), slope = cycles / 29.5;
      const dvec3 along = glm::normalize(sight.axes.direction) * slope;
      return [=](dvec3 x) { return std::abs(std::remainder(glm::dot(x, along), 2)); };
    }
  }
}

/// Returns a curve that is smooth over 0 .. 400 and a comb or a ramp over 1000 .. 2000.
std::vector<CurvePoint> curveOfDetail(Chance& chance, double body, double detail) {
  std::vector<CurvePoint> points{
      {0, chance.colour(), 0}, {400, chance.colour(), body}, {700, chance.colour(), body}};
  const std::vector<CurvePoint> rest = chance.oneIn(3) ? ramp(chance, {1000, 2000}, 0.2, 0.5, detail)
                                                       : anyComb(chance, {1000, 2000}, 60, detail);
  points.insert(points.end(), rest.begin(), rest.end());
  return points;
}

void showSight(Chance& chance, RandomCase& c, const Sight& sight, const ValueAt& value) {
  around(chance, c, volumeOf(sight.geometry.size, dmat3(1), value));
  c.scene.camera = sight.camera;
  if (chance.oneIn(2)) c.scene.shading.lit = false;
}

/// A smooth translucent body, of which a small part of the picture is full of detail along the whole rays.
void detailInAPart(Chance& chance, RandomCase& c) {
  const Sight sight(chance, 32, 96);
  const ShareAt part = anyPart(chance, sight);
  const ValueAt detail = anyDetail(chance, sight), body = hill(sight.geometry.size);
  showSight(chance, c, sight, [&](dvec3 x) {
    const double share = part(sight.placeOf(x));
    return (1 - share) * 400 * body(x) + share * (1000 + 1000 * detail(x));
  });
  const double opacity = chance.power(-1.5, -0.05);
  c.scene.transferFunction.points = curveOfDetail(chance, opacity * chance.power(-1, 0), opacity);
  setDepth(c, opacity, chance.power(-0.3, 1.5));
}

/// The same, but of little depth: a small piece in the body or in front of it.
void smallPiece(Chance& chance, RandomCase& c) {
  const Sight sight(chance, 32, 96);
  const ValueAt detail = anyDetail(chance, sight), body = hill(sight.geometry.size);
  const double least = std::min({sight.geometry.size.x, sight.geometry.size.y, sight.geometry.size.z});
  const double radius = least * chance.between(0.04, 0.15);
  const dvec3 centre = 0.35 * least * chance.vector();
  showSight(chance, c, sight, [&](dvec3 x) {
    const double share = within(glm::distance(sight.fromCentre(x), centre) - radius, 1);
    return (1 - share) * 400 * body(x) + share * (1000 + 1000 * detail(x));
  });
  const double opacity = chance.power(-1, -0.02);
  c.scene.transferFunction.points = curveOfDetail(chance, opacity * chance.power(-2, -0.5), opacity);
  setDepth(c, opacity, chance.power(0.3, 2));
}

/// Nearly nothing but a few bright things: a dot, wires, a clump of dust or dust all over.
void nearlyNothing(Chance& chance, RandomCase& c) {
  const Sight sight(chance, 32, 96);
  const dvec3 size(sight.geometry.size), centre = size * (0.5 + 0.35 * chance.vector());
  const dvec3 along = anyDirection(chance);
  const ValueAt grain = noise(chance);
  const int kind = chance.below(4);
  const double radius = chance.between(0.5, 2), rarity = chance.power(-4.5, -2.5);
  const double clump = chance.between(2, 6);
  showSight(chance, c, sight, [&](dvec3 x) {
    const dvec3 from = x - centre;
    const double dust = grain(x);
    if (kind == 0) return 1000 * within(glm::length(from) - radius, 1);
    if (kind == 1) return 1000 * within(glm::length(glm::cross(from, along)) - radius / 2, 1);
    if (kind == 2) return glm::length(from) < clump && dust < 0.3 ? 1000.0 : 0;
    return dust < rarity ? 1000.0 : 0;
  });
  const double start = chance.between(0.02, 0.9), opacity = chance.between(0.3, 1);
  c.scene.transferFunction.points = ramp(chance, {0, 1000}, start, chance.power(-3, -0.5), opacity);
  if (chance.oneIn(3))
    c.scene.transferFunction.points = anyComb(chance, {50, 1000}, 10 + chance.below(100), opacity);
  c.scene.transferFunction.points.insert(c.scene.transferFunction.points.begin(), {0, dvec3(0), 0});
  c.scene.transferFunction.unitDistance = chance.power(-2, 0.3);
  if (chance.oneIn(2)) c.scene.background = {false, dvec3(0)};
}

/// A smooth opaque wall covers all but a part of the picture, where the whole depth of detail shows.
void holeInAWall(Chance& chance, RandomCase& c) {
  const Sight sight(chance, 32, 96);
  const ShareAt part = anyPart(chance, sight);
  const ValueAt detail = anyDetail(chance, sight);
  const double wall = -0.2 * sight.geometry.size.x;
  showSight(chance, c, sight, [&](dvec3 x) {
    const double hole = part(sight.placeOf(x));
    const double front = within(glm::dot(sight.fromCentre(x), sight.axes.direction) - wall, 3);
    const double solid = front * (1 - hole);
    return solid * 500 + (1 - solid) * (1000 + 1000 * detail(x));
  });
  const double opacity = chance.power(-1.5, -0.1);
  c.scene.transferFunction.points = curveOfDetail(chance, 0.9999, opacity);
  setDepth(c, opacity, chance.power(0, 1.3));
}

/// Rare fine wires: their pixels are about the hundredth part that a 99th percentile ignores.
void aboutOnePercent(Chance& chance, RandomCase& c) {
  const Sight sight(chance, 48, 96);
  const ValueAt body = hill(sight.geometry.size), detail = anyDetail(chance, sight);
  const double share = chance.between(0.009, 0.02);
  const int count = 1 + chance.below(4);
  std::vector<ShareAt> parts;
  for (int n = 0; n < count; ++n) parts.push_back(strip(chance, share / count, 0.7 * sight.voxel()));
  showSight(chance, c, sight, [&](dvec3 x) {
    double most = 0;
    for (const ShareAt& part : parts) most = std::max(most, part(sight.placeOf(x)));
    return (1 - most) * 400 * body(x) + most * (1000 + 1000 * detail(x));
  });
  const double opacity = chance.power(-1.3, -0.05);
  c.scene.transferFunction.points = curveOfDetail(chance, opacity * chance.share(), opacity);
  setDepth(c, opacity, chance.power(-0.3, 1.3));
}

/// Detail fades slowly across the picture, so that the error is small in most tiles and large in few.
void fadingDetail(Chance& chance, RandomCase& c) {
  const Sight sight(chance, 32, 96);
  const ValueAt detail = anyDetail(chance, sight);
  const dvec2 from(chance.between(-0.5, 0.5), chance.between(-0.5, 0.5));
  const double reach = chance.power(-1.3, -0.3);
  showSight(chance, c, sight, [&](dvec3 x) {
    const double off = glm::distance(sight.placeOf(x), from) / reach;
    return 1500 + 1000 * (detail(x) - 0.5) * std::exp(-off * off);
  });
  const double opacity = chance.power(-2, -0.1);
  c.scene.transferFunction.points = anyComb(chance, {1000, 2000}, 20 + chance.below(100), opacity);
  setDepth(c, opacity, chance.power(-0.5, 1));
}

constexpr Kind kindsOfSpots[] = {{"detail in a part", detailInAPart},
                                 {"small piece", smallPiece},
                                 {"nearly nothing", nearlyNothing},
                                 {"hole in a wall", holeInAWall},
                                 {"about one percent", aboutOnePercent},
                                 {"fading detail", fadingDetail},
                                 // drawn twice as often as others
                                 {"detail in a part", detailInAPart},
                                 {"nearly nothing", nearlyNothing}};

}  // namespace

std::span<const Kind> blindSpotKinds() { return kindsOfSpots; }

}  // namespace volumen::tests::hostile
