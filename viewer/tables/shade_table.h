#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viewer/tables/curve_table.h"
#include "viewer/tables/lighting.h"

namespace volumen {

/// The table that the paper rejects (2.2, figure 3b): the shaded colour (picture.md 5) over (Gx, Gy, Gz,
/// density). It has 5 bits per index and 8 bits per component. Opacity is not included and comes from the
/// curve. Gradient components are rounded to 31 values -limit .. limit, so that a zero gradient stays zero.
/// Densities are rounded to 32 values from the smallest to the largest. Colours are limited to 1.
struct ShadeTable {
  static constexpr int indexBits = 5, side = 1 << indexBits;
  static constexpr int zero = 15;  ///< The index of a gradient component of 0. The last index is never used.
  float perGradient = 0;           ///< Steps per unit of the stored gradient.
  float densityLow = 0, perDensity = 0;
  /// Index ((z * side + y) * side + x) * side + density; red in the lowest byte.
  std::vector<std::int32_t> bgr;
  std::size_t bytes() const { return bgr.size() * sizeof(std::int32_t); }
};

/// Inputs of a table other than the light.
struct ShadeTableInput {
  std::array<float, 9> gradientMatrix;  ///< Row-major: stored gradient to real value per mm in patient space.
  float inverseFloor = 0;               ///< 1 / gradientFloor; 0: q = 0 everywhere.
  double gradientLimit = 1;             ///< The largest component that a stored gradient can have.
  DensityScale scale;
};

ShadeTable makeShadeTable(const Lighting& lighting, const CurveTable& curve, const ShadeTableInput& input);

}  // namespace volumen
