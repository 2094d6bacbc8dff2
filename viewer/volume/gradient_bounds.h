#pragma once

#include <vector>

#include "viewer/volume/block_ranges.h"

namespace volumen {

/// How steeply values rise, by value: entry n bounds the gradient (value per voxel) in the cells of all
/// blocks that hold a value of the n-th of 256 equal parts of `range`, the values' own range.
std::vector<float> gradientBoundsOf(const Volume& volume, const BlockRanges& blockRanges, ValueRange range);

/// The entry of a value; the nearest one's for values outside.
std::size_t gradientBoundEntry(double value, ValueRange range);

}  // namespace volumen
