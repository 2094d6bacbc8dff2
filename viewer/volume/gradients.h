#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "viewer/volume/buffer.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// 3D Sobel at one voxel (picture.md 3): along the axis [-1 0 1]/2, along the other two [1 2 1]/4, neighbours
/// clamped. In real value per voxel. The plain double-precision definition that the fast ones are tested
/// against.
glm::dvec3 sobelAt(const Volume& volume, int i, int j, int k);

/// Sobel gradients of a whole volume with its densities as four 16-bit integers a voxel (x, y, z, density), i
/// fastest: the paper's voxel (2.3) at 16 bits. G (real value per voxel) = scale * integer. The scale is a
/// power of two times slope / 32, so small ranges lose nothing. The density is the stored sample, 32768 less
/// where samples are unsigned 16-bit.
struct Gradients16 {
  Buffer<std::int16_t> xyzd;
  double scale = 1;
  int rowVoxels = 0;  ///< from the start of a row along i to that of the next (rowStride)

  /// The voxels of row n: of those along i at j, k that is size.y * k + j.
  std::int16_t* row(std::size_t n) { return xyzd.data() + 4 * (n * rowVoxels); }
  const std::int16_t* row(std::size_t n) const { return xyzd.data() + 4 * (n * rowVoxels); }
};

/// Sobel gradients as four floats a voxel (x, y, z, 0). G (real value per voxel) = scale * float. The scale
/// is 1 for ordinary floats (FloatUnits) and the slope's size for integers.
struct Gradients32 {
  Buffer<float> xyz0;
  double scale = 1;
};

/// How a gradient is estimated from the 3 x 3 x 3 neighbours, clamped: Sobel's is the picture's definition
/// (picture.md 3); central differences of the two neighbours along each axis; Zucker and Hummel (1981): all
/// neighbours, weighted inversely as their distance.
enum class GradientOperator { sobel, central, zuckerHummel };

/// Gradients16::scale of a volume of these values (real units) and slope.
double gradients16Scale(ValueRange range, double slope);
/// Whether Sobel gradients of such a volume are rounded in Gradients16; those of few values are kept exactly.
bool gradients16AreRounded(ValueRange range, double slope);

/// Room for the gradients of such a grid.
Gradients16 makeGradients16(glm::ivec3 size, double scale);

/// Computed on all cores, SIMD; `volume` must hold 8- or 16-bit integers.
Gradients16 sobel16(const Volume& volume);
/// The same for any volume.
Gradients32 sobel32(const Volume& volume);

/// What is done with a row of voxels along i: `first` is the index of its first voxel, `xyz0` its gradients
/// as in Gradients32, which last for the call only.
using UseGradientRow = std::function<void(std::size_t first, const float* xyz0)>;
/// The numbers of sobel32 row by row, on all cores, in no fixed order: nothing is kept. Returns their scale.
double sobelRows(const Volume& volume, const UseGradientRow& use);

/// By any operator; on all cores. The same conditions and units.
Gradients16 gradients16By(const Volume& volume, GradientOperator by);
Gradients32 gradients32By(const Volume& volume, GradientOperator by);
double gradientRowsBy(const Volume& volume, GradientOperator by, const UseGradientRow& use);

}  // namespace volumen
