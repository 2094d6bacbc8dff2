#pragma once

#include <optional>
#include <string>

#include "results/series/loaded_series.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// Returns the value range of span `number` (from 0) of a transfer function, for a segment. The range is
/// clipped to the series' values and rounded inwards to displayed numbers, because opacity is zero at a
/// span's foot. It stays unrounded if rounding would leave nothing. A span outside the series' values gives a
/// range that no voxel has. Empty if there is no such span.
std::optional<ValueRange> rangeOfSpan(const TransferFunction& curve, int number, const LoadedSeries& series);

/// Returns the value range of a segment that follows this curve. Empty if it follows none, or if the curve's
/// number of spans has changed since the segment was bound to one.
std::optional<ValueRange> rangeFollowed(const Segment& segment, const TransferFunction& curve,
                                        const LoadedSeries& series);

/// Returns a segment's name from its value range in displayed units: "150 to 3000 HU".
std::string nameOfRange(const ValueRange& range, const Series& series);

}  // namespace volumen
