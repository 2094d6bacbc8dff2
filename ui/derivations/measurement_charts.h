#pragma once

#include <optional>

#include "results/numbers/measurement_chart.h"
#include "results/series/time_steps.h"
#include "ui/controller/frame_service.h"
#include "ui/document/derivation.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Inputs of the chart of a measurement.
struct ChartKey {
  SeriesKey series;
  Shape shape;
  ChartKind kind = ChartKind::profile;
  Interpolation interpolation = Interpolation::linear;
  std::vector<SeriesKey> steps{};  ///< time points, if the chart is over time
  ValueScale scale{};
  LoadedSeriesPtr values{};  ///< source of the values
  LoadedFramePtr frame{};    ///< the frame that was measured; null for a volume
  bool operator==(const ChartKey&) const = default;
};

using MeasurementCharts = Derivation<ChartKey, MeasuredChart>;

/// Returns the inputs of a measurement's chart; nothing if its series or frame is not in memory.
std::optional<ChartKey> chartKeyOf(const Session& session, FrameService& frames,
                                   const Measurement& measurement, ChartKind kind);

/// Returns the rule for the one chart that `wanted` names, if any. A job reads time points that are not in
/// memory, one after another. The user can cancel it.
MeasurementCharts::Rule measurementChartsRule(const Session& session,
                                              std::function<std::optional<ChartKey>()> wanted);

/// Returns the time points of a series in the workspace, in the unit shown.
TimeSteps timeStepsOf(const Session& session, const SeriesKey& series);

}  // namespace volumen
