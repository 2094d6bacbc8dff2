#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/workspace/measurement_chart.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// Values of a segment in a step of its series, in the unit that is shown.
struct StepValues {
  double mean = 0, sd = 0;  ///< sd by n
  double min = 0, max = 0;
};

/// The values of segments in each step of their series, of the same voxels.
struct SegmentsOverTime {
  StepAxis axis;
  std::string unit;
  /// Of each segment, step after step; none: no voxel has a value, or the step cannot be read.
  std::vector<std::vector<std::optional<StepValues>>> segments;
};

/// The mean of each of these segments over time, with its SD at each point, in their colours. `chosen`: which
/// of the segments, whose reports are `all`.
MeasuredChart segmentsOverTimeChart(const SegmentsOverTime& values, std::span<const SegmentReport> all,
                                    std::span<const std::size_t> chosen);

/// A list of the steps of one segment: `at` along the axis, `mean`, `sd`, `min`, `max`; null where there is
/// no value.
nlohmann::ordered_json timePointsJson(const SegmentsOverTime& values, std::size_t segment);
/// Adds them to the JSON of the numbers of these segments: `timeAxis`, and the list of each of `segments`.
void addTimePoints(nlohmann::ordered_json& numbers, const SegmentsOverTime& values);

}  // namespace volumen
