#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viewer/tables/curve_table.h"
#include "viewer/tables/lighting.h"

namespace volumen {

/// The table that the paper rejects (2.2, figure 3b): the shaded colour (picture.md 5) over (Gx, Gy, Gz,
/// density), 5 bits an index, 8 bits a component. Opacity is not in it, it stays the curve's. Gradient
/// components are rounded to 31 values -limit .. limit, so that no gradient stays none; densities to 32
/// values from the smallest to the largest. Colours above 1 are cut off.
struct ShadeTable {
  static constexpr int indexBits = 5, side = 1 << indexBits;
  static constexpr int zero = 15;  ///< the index of a gradient component of 0; the last index is never used
  float perGradient = 0;           ///< steps a unit of the stored gradient
  float densityLow = 0, perDensity = 0;
  std::vector<std::int32_t> bgr;  ///< ((z * side + y) * side + x) * side + density; red in the lowest byte
  std::size_t bytes() const { return bgr.size() * sizeof(std::int32_t); }
};

/// What a table depends on beside the light.
struct ShadeTableInput {
  std::array<float, 9> gradientMatrix;  ///< row-major: stored gradient -> real value per mm, patient space
  float inverseFloor = 0;               ///< 1 / gradientFloor; 0: q = 0 everywhere
  double gradientLimit = 1;             ///< the largest component that a stored gradient can have
  DensityScale scale;
};

ShadeTable makeShadeTable(const Lighting& lighting, const CurveTable& curve, const ShadeTableInput& input);

}  // namespace volumen
