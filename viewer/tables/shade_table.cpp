#include "viewer/tables/shade_table.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

glm::dvec3 colourOf(const CurveTable& t, double density) {
  int s = 0;
  while (s + 1 < t.segments && density >= t.node[s]) ++s;
  const double along = density - t.start[s];
  const glm::dvec3 c(t.red[s] + along * t.redRise[s], t.green[s] + along * t.greenRise[s],
                     t.blue[s] + along * t.blueRise[s]);
  return glm::clamp(c, 0.0, 1.0);
}

// Returns D'' and S'' of picture.md 5 for a stored gradient.
Shade shadeOfGradient(const Lighting& lighting, const ShadeTableInput& in, glm::dvec3 stored) {
  const auto& m = in.gradientMatrix;
  const glm::dvec3 g(glm::dot(glm::dvec3(m[0], m[1], m[2]), stored),
                     glm::dot(glm::dvec3(m[3], m[4], m[5]), stored),
                     glm::dot(glm::dvec3(m[6], m[7], m[8]), stored));
  const double length = glm::length(g), q = std::min(1.0, length * in.inverseFloor);
  const glm::dvec3 flat = lighting.flat;
  if (!(length > 0)) return {flat, glm::dvec3(0)};
  const Shade shade = shadeOf(lighting, -g / length);
  return {flat + q * (shade.d - flat), q * shade.s};
}

std::int32_t inBytes(glm::dvec3 colour) {
  const glm::ivec3 c = glm::ivec3(255.0 * glm::clamp(colour, 0.0, 1.0) + 0.5);
  return c.r | c.g << 8 | c.b << 16;
}

}  // namespace

ShadeTable makeShadeTable(const Lighting& lighting, const CurveTable& curve, const ShadeTableInput& in) {
  constexpr int side = ShadeTable::side;
  ShadeTable t;
  const double width = in.scale.high - in.scale.low, step = in.gradientLimit / ShadeTable::zero;
  t.perGradient = step > 0 ? float(std::min(1 / step, 1e30)) : 0.0f;
  t.densityLow = float(in.scale.low);
  t.perDensity = width > 0 ? float(std::min((side - 1) / width, 1e30)) : 0.0f;
  t.bgr.resize(std::size_t(side) * side * side * side);
  std::array<glm::dvec3, side> colours;
  for (int d = 0; d < side; ++d) colours[d] = colourOf(curve, in.scale.low + d * width / (side - 1));
  parallelFor(std::int64_t(side) * side, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t zy = begin; zy < end; ++zy)
      for (int x = 0; x < side; ++x) {
        const glm::dvec3 index(x, double(zy % side), double(zy / side));
        const Shade shade = shadeOfGradient(lighting, in, step * (index - double(ShadeTable::zero)));
        std::int32_t* entry = &t.bgr[(zy * side + x) * side];
        for (int d = 0; d < side; ++d) entry[d] = inBytes(colours[d] * shade.d + shade.s);
      }
  });
  return t;
}

}  // namespace volumen
