#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/numbers/measurement_chart.h"
#include "results/numbers/segment_report.h"
#include "results/segments/segment_map.h"
#include "results/series/time_steps.h"

namespace volumen {

/// Values of a segment at one time point of its series, in the displayed unit.
struct StepValues {
  double mean = 0, sd = 0;  ///< sd with divisor n
  double min = 0, max = 0;
};

/// Values of segments at each time point of their series, over the same voxels.
struct SegmentsOverTime {
  StepAxis axis;
  std::string unit;
  /// For each segment, one entry per time point; empty: no voxel has a value, or it cannot be read.
  std::vector<std::vector<std::optional<StepValues>>> segments;
};

/// Returns the values of all segments at each time point of their series, map after map. `unit` is the unit
/// of the values. Slow; a cancelled result is incomplete.
SegmentsOverTime segmentsIn(const TimeSteps& steps, const std::vector<SegmentMap>& maps,
                            const std::string& unit, const Progress& progress = {},
                            const CancelToken& cancel = {});

/// Returns the mean of segments over time, with its SD at each point, in their colours. `chosen` are indices
/// of segments, whose reports are `all`.
MeasuredChart segmentsOverTimeChart(const SegmentsOverTime& values, std::span<const SegmentReport> all,
                                    std::span<const std::size_t> chosen);

/// Returns the time points of one segment: `at` along the axis, `mean`, `sd`, `min`, `max`; null without a
/// value.
nlohmann::ordered_json timePointsJson(const SegmentsOverTime& values, std::size_t segment);
/// Adds `timeAxis` and the time points of each segment to the JSON of these segments' numbers.
void addTimePoints(nlohmann::ordered_json& numbers, const SegmentsOverTime& values);

}  // namespace volumen
