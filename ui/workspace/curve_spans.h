#pragma once

#include <optional>
#include <string>

#include "ui/data/loaded_series.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// The values that a span of a curve offers for a segment, `number` from 0: within those of the series, and
/// rounded inwards to the numbers on screen, as at its foot itself the curve shows nothing; as they are where
/// nothing would be left. Of a span beside the values of the series one that none of them has. None: there is
/// no such span.
std::optional<ValueRange> rangeOfSpan(const TransferFunction& curve, int number, const LoadedSeries& series);

/// The values that a segment has which follows this curve; none: it follows none, or the curve shows another
/// number of spans than when the segment was bound to one.
std::optional<ValueRange> rangeFollowed(const Segment& segment, const TransferFunction& curve,
                                        const LoadedSeries& series);

/// What a segment of these values is called, in the numbers on screen: "150 to 3000 HU".
std::string nameOfRange(const ValueRange& range, const Series& series);

}  // namespace volumen
