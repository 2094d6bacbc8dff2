#pragma once

#include <cstdint>

#include "viewer/volume/buffer.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Densities as bytes: real value = low + unit * byte. The unit is 1/255 of the volume's value range, and no
/// value is off by more than half of it; of integers that span at most 256 steps of the rescale slope it is
/// that step, and every value is kept.
struct ByteScale {
  double low = 0, unit = 1;
  bool exact = false;
};

/// Whether integers of this range (real values) and slope are kept exactly in bytes.
bool bytesHoldExactly(ValueRange range, double slope);

/// The scale of a volume of this range (valueRange()).
ByteScale byteScale(const Volume& volume, ValueRange range);

/// Densities as one byte a voxel, i fastest.
struct Density8 {
  Buffer<std::uint8_t> bytes;
  ByteScale scale;
};

/// The paper's voxel (2.3): four bytes, i fastest. The lower three of each word are the gradient's x, y, z as
/// two's complement, G (real value per voxel) = gradientUnit * byte; the highest is the density. The unit is
/// 1/127 of the largest component that is there, and no component is off by more than half of it.
struct Voxels8 {
  Buffer<std::uint32_t> words;
  ByteScale scale;
  double gradientUnit = 1;
  int rowVoxels = 0;  ///< from the start of a row along i to that of the next (rowStride)

  /// The voxels of row n, counted as in Gradients16.
  std::uint32_t* row(std::size_t n) { return words.data() + n * rowVoxels; }
  const std::uint32_t* row(std::size_t n) const { return words.data() + n * rowVoxels; }
};

// Made on all cores; the same bytes for any number of them.
Density8 densities8(const Volume& volume, const ByteScale& scale);
Voxels8 voxels8By(const Volume& volume, GradientOperator by, const ByteScale& scale);

}  // namespace volumen
