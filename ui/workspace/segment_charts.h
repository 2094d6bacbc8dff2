#pragma once

#include <span>

#include "ui/workspace/measurement_chart.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// Its name and colour.
ChartLineLook lookOf(const Segment& segment);

/// The histograms of segments (SegmentValues::histogram), a staircase each, in their colours.
MeasuredChart segmentHistograms(std::span<const SegmentReport> segments, const ValueScale& scale);

}  // namespace volumen
