#pragma once

#include <span>

#include "results/numbers/measurement_chart.h"
#include "results/numbers/segment_report.h"

namespace volumen {

/// Returns name and colour of a segment.
ChartLineLook lookOf(const Segment& segment);

/// Returns the histograms of segments (SegmentValues::histogram) as staircases in their colours.
MeasuredChart segmentHistograms(std::span<const SegmentReport> segments, const ValueScale& scale);

}  // namespace volumen
