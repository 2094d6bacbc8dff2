#pragma once

#include <cstdint>

#include "viewer/volume/buffer.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Scale of densities as bytes: real value = low + unit * byte. The unit is 1/255 of the value range, with
/// errors of at most half a unit. For integers spanning at most 256 steps of the rescale slope, it is that
/// step, and every value is exact.
struct ByteScale {
  double low = 0, unit = 1;
  bool exact = false;
};

/// Returns whether bytes hold integers of this range (real values) and slope exactly.
bool bytesHoldExactly(ValueRange range, double slope);

/// Returns the scale for a volume of this range (valueRange()).
ByteScale byteScale(const Volume& volume, ValueRange range);

/// Densities as one byte per voxel, i fastest.
struct Density8 {
  Buffer<std::uint8_t> bytes;
  ByteScale scale;
};

/// The paper's voxel (2.3): four bytes per voxel, i fastest. The lower three are the gradient's x, y, z in
/// two's complement, with G (real value per voxel) = gradientUnit * byte; the highest is the density. The
/// unit is 1/127 of the largest component, and component errors are at most half a unit.
struct Voxels8 {
  Buffer<std::uint32_t> words;
  ByteScale scale;
  double gradientUnit = 1;
  int rowVoxels = 0;  ///< Distance between rows along i, in voxels (rowStride)

  /// Returns the voxels of row n, counted as in Gradients16.
  std::uint32_t* row(std::size_t n) { return words.data() + n * rowVoxels; }
  const std::uint32_t* row(std::size_t n) const { return words.data() + n * rowVoxels; }
};

// Computed on all cores; the same bytes for any number of cores.
Density8 densities8(const Volume& volume, const ByteScale& scale);
Voxels8 voxels8By(const Volume& volume, GradientOperator by, const ByteScale& scale);

}  // namespace volumen
