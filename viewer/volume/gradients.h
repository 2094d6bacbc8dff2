#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "viewer/volume/buffer.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Returns the 3D Sobel gradient at one voxel (picture.md 3) in real value per voxel: [-1 0 1]/2 along its
/// axis, [1 2 1]/4 along the other two, neighbours clamped. This is the plain double-precision definition
/// that fast versions are tested against.
glm::dvec3 sobelAt(const Volume& volume, int i, int j, int k);

/// Sobel gradients and densities of a volume as four 16-bit integers per voxel (x, y, z, density), i fastest:
/// the paper's voxel (2.3) at 16 bits. G (real value per voxel) = scale * integer. The scale is a power of
/// two times slope / 32, so that small ranges lose nothing. The density is the stored sample, minus 32768 for
/// unsigned 16-bit samples.
struct Gradients16 {
  Buffer<std::int16_t> xyzd;
  double scale = 1;
  int rowVoxels = 0;  ///< Distance between rows along i, in voxels (rowStride)

  /// Returns the voxels of row n = size.y * k + j, which runs along i.
  std::int16_t* row(std::size_t n) { return xyzd.data() + 4 * (n * rowVoxels); }
  const std::int16_t* row(std::size_t n) const { return xyzd.data() + 4 * (n * rowVoxels); }
};

/// Sobel gradients as four floats per voxel (x, y, z, 0). G (real value per voxel) = scale * float. The scale
/// is 1 for ordinary floats (FloatUnits) and |slope| for integers.
struct Gradients32 {
  Buffer<float> xyz0;
  double scale = 1;
};

/// Gradient estimators from the 3 x 3 x 3 neighbours, clamped: Sobel, the definition of pictures (picture.md
/// 3); central differences along each axis; Zucker and Hummel (1981), which weights all neighbours by inverse
/// distance.
enum class GradientOperator { sobel, central, zuckerHummel };

/// Returns Gradients16::scale for a volume of this range (real units) and slope.
double gradients16Scale(ValueRange range, double slope);
/// Returns whether Gradients16 rounds the Sobel gradients of such a volume; small ranges stay exact.
bool gradients16AreRounded(ValueRange range, double slope);

/// Allocates gradients for a grid of this size.
Gradients16 makeGradients16(glm::ivec3 size, double scale);

/// Returns Sobel gradients, computed with SIMD on all cores. `volume` must hold 8- or 16-bit integers.
Gradients16 sobel16(const Volume& volume);
/// Returns the same for any volume, as floats.
Gradients32 sobel32(const Volume& volume);

/// Callback for a row of voxels along i. `first` is the index of its first voxel, `xyz0` its gradients as in
/// Gradients32, valid during the call.
using UseGradientRow = std::function<void(std::size_t first, const float* xyz0)>;
/// Computes sobel32() row by row on all cores, in no fixed order, without storing it. Returns the scale.
double sobelRows(const Volume& volume, const UseGradientRow& use);

/// The same with any operator, on all cores, under the same conditions and in the same units.
Gradients16 gradients16By(const Volume& volume, GradientOperator by);
Gradients32 gradients32By(const Volume& volume, GradientOperator by);
double gradientRowsBy(const Volume& volume, GradientOperator by, const UseGradientRow& use);

}  // namespace volumen
