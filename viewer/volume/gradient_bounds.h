#pragma once

#include <vector>

#include "viewer/volume/block_ranges.h"

namespace volumen {

/// Returns bounds of the gradient (value per voxel) by value. Entry n bounds it in all blocks that hold a
/// value of the n-th of 256 equal parts of `range`, the range of all values.
std::vector<float> gradientBoundsOf(const Volume& volume, const BlockRanges& blockRanges, ValueRange range);

/// Returns the entry of a value, clamped to the ends.
std::size_t gradientBoundEntry(double value, ValueRange range);

}  // namespace volumen
