// Kinds of the family "hostile": volumes with detail everywhere.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_hostile.h"

namespace volumen::tests::hostile {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

/// Sets a ramp over the values, opaque or translucent, and a view.
void showDetail(Chance& chance, RandomCase& c) {
  const double start = chance.between(0, 0.9), wide = chance.power(-3, 0);
  const double opacity = chance.oneIn(3) ? 1 - chance.power(-6, -1) : chance.between(0.05, 0.9);
  c.scene.transferFunction.points = ramp(chance, rangeOf(c), start, wide, opacity);
  if (chance.oneIn(2)) c.scene.transferFunction.points[0].colour = dvec3(0);
  setDepth(c, opacity, chance.power(-0.3, 2));
  const dvec3 direction = nearly(chance, directionOfSmallNumbers(chance));
  const double part = chance.power(-1, 0);
  if (!chance.oneIn(3)) lookAlong(chance, c, direction, part);
  if (chance.oneIn(4)) lookFromInside(chance, c);
}

void aroundShares(Chance& chance, RandomCase& c, ivec3 size, const ValueAt& share) {
  if (chance.oneIn(2))
    around(chance, c,
           volumeOf<std::int16_t>(size, dmat3(1), [&](dvec3 x) { return std::round(1000 * share(x)); }));
  else
    around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * share(x); }));
}

void lattice(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 12, 96);
  aroundShares(chance, c, size, anyLattice(chance));
  showDetail(chance, c);
}

void latticeInABody(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 96);
  const ValueAt detail = anyLattice(chance), body = ball(size, 0.4);
  const double height = chance.power(-2, 0);
  aroundShares(chance, c, size, [&](dvec3 x) { return body(x) * (0.5 + height * detail(x)); });
  showDetail(chance, c);
}

/// Plates seen nearly edge-on.
void grazedPlates(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 96);
  const dvec3 normal = anyDirection(chance);
  const double period = chance.between(3, 12), thick = chance.between(0.8, 3);
  aroundShares(chance, c, size, plates(normal, period, thick));
  showDetail(chance, c);
  const dvec3 along = glm::normalize(glm::cross(normal, chance.vector()));
  const double tilt = chance.oneIn(4) ? 0 : chance.power(-3, -0.7);
  lookAlong(chance, c, along + tilt * normal);
}

/// Rods about parallel to the rays, so that most pixels show a silhouette.
void rodsAlongRays(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 96);
  const dvec3 along = anyDirection(chance);
  const dvec3 first = glm::normalize(glm::cross(along, chance.vector())), second = glm::cross(along, first);
  const double period = chance.between(4, 12), radius = period * chance.between(0.15, 0.45);
  aroundShares(chance, c, size, [&](dvec3 x) {
    const double u = std::remainder(glm::dot(x, first), period),
                 v = std::remainder(glm::dot(x, second), period);
    return std::clamp(radius + 0.5 - std::hypot(u, v), 0.0, 1.0);
  });
  showDetail(chance, c);
  const double tilt = chance.power(-3, -0.7);
  lookAlong(chance, c, along + tilt * chance.vector());
}

void spongeOfBalls(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 80);
  const double share = chance.power(-1.5, -0.3);  // of the volume, if no balls overlap
  const int count = 1 + int(share * size.x * size.y * size.z / 90);
  aroundShares(chance, c, size, sponge(chance, size, count));
  showDetail(chance, c);
}

void trabecularBone(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 20, 96);
  const ValueAt bars = network(chance), marrow = ripples(chance, 20, 3);
  const double sharp = chance.between(1, 8), level = chance.between(0, 0.5);
  aroundShares(chance, c, size, [&](dvec3 x) {
    return 0.1 * marrow(x) + 0.9 * std::clamp(0.5 + sharp * (bars(x) - level), 0.0, 1.0);
  });
  showDetail(chance, c);
}

/// Black and white layers or blocks, all of the same opacity.
void blackAndWhite(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 12, 96);
  const ValueAt detail = chance.oneIn(3) ? noise(chance) : anyLattice(chance);
  aroundShares(chance, c, size, detail);
  const double opacity = chance.between(0.02, 0.95), wide = chance.power(-3, 0);
  c.scene.transferFunction.points = {{float(500 - 500 * wide), dvec3(0), opacity},
                                     {float(500 + 500 * wide), dvec3(1), opacity}};
  if (chance.oneIn(3)) c.scene.transferFunction.points[0].opacity *= chance.share();
  setDepth(c, opacity, chance.power(-0.5, 1.5));
  c.scene.shading.lit = chance.oneIn(4);
  lookAlong(chance, c, nearly(chance, directionOfSmallNumbers(chance)));
}

/// Many samples of small opacity pile up along a ray.
void deepAndFaint(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 64, 96);
  const ValueAt detail = chance.oneIn(3) ? noise(chance) : ripples(chance, chance.between(2, 8), 5);
  aroundShares(chance, c, size, detail);
  const double opacity = chance.power(-4, -1);
  c.scene.transferFunction.points =
      band(chance, rangeOf(c), chance.between(0.3, 0.8), chance.power(-2, -0.3), opacity);
  if (chance.oneIn(3)) c.scene.transferFunction.points = anyComb(chance, {200, 800}, 10, opacity);
  setDepth(c, opacity, chance.power(-0.3, 1));
  if (chance.oneIn(2)) lookAlong(chance, c, nearly(chance, directionOfSmallNumbers(chance)));
}

void wavesOfFewVoxels(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 80);
  const double period = chance.between(2, 6);
  aroundShares(chance, c, size, ripples(chance, period, 1 + chance.below(4)));
  showDetail(chance, c);
  if (chance.oneIn(2))
    c.scene.transferFunction.points =
        band(chance, rangeOf(c), chance.between(0.2, 0.8), chance.power(-2.5, -0.5), chance.share());
}

/// Fine vessels that wind through a smooth body.
void vessels(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 32, 96);
  const ValueAt first = ripples(chance, 15, 4), second = ripples(chance, 15, 4), body = hill(size);
  const double thin = chance.power(-2.3, -1.2);
  aroundShares(chance, c, size, [&](dvec3 x) {
    const double off = std::hypot(first(x) - 0.5, second(x) - 0.5) / thin;
    return 0.3 * body(x) + 0.7 * std::clamp(1.5 - off, 0.0, 1.0);
  });
  showDetail(chance, c);
  c.scene.transferFunction.points.insert(c.scene.transferFunction.points.begin(),
                                         {0, chance.colour(), chance.power(-3, -1)});
  auto& points = c.scene.transferFunction.points;
  points[0].value = std::min(points[0].value, points[1].value);
}

/// Steps between thick slices, as of a table or of an implant.
void thickSlices(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 64);
  const dmat3 grid = spacing({0.5, 0.5, chance.between(2, 5)});
  const ValueAt share = sponge(chance, size, 10 + chance.below(200)), grain = noise(chance);
  around(chance, c, volumeOf<std::int16_t>(size, grid, [&](dvec3 x) {
           return std::round(1500 * share(x) + 30 * grain(x));
         }));
  showDetail(chance, c);
}

/// A thin slab cut out of detail: rays have none to a few samples.
void slabOfDetail(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 64);
  aroundShares(chance, c, size, chance.oneIn(2) ? noise(chance) : anyLattice(chance));
  showDetail(chance, c);
  const dvec3 normal = anyDirection(chance);
  const double offset = glm::dot(normal, c.volume->geometry().centre()), thick = chance.power(-1, 0.7);
  c.scene.clip.planes = {{normal, offset + thick},
                         {-normal + chance.power(-4, -1) * chance.vector(), -offset}};
}

constexpr Kind kindsOfVolumes[] = {{"oblique lattice", lattice},
                                   {"lattice in a body", latticeInABody},
                                   {"grazed plates", grazedPlates},
                                   {"rods along rays", rodsAlongRays},
                                   {"sponge of balls", spongeOfBalls},
                                   {"trabecular bone", trabecularBone},
                                   {"black and white", blackAndWhite},
                                   {"deep and faint", deepAndFaint},
                                   {"waves of few voxels", wavesOfFewVoxels},
                                   {"vessels", vessels},
                                   {"thick slices", thickSlices},
                                   {"slab of detail", slabOfDetail}};

}  // namespace

std::span<const Kind> volumeKinds() { return kindsOfVolumes; }

}  // namespace volumen::tests::hostile
