#include "ui/derivations/measurement_charts.h"

#include <algorithm>
#include <utility>

#include "results/series/loaded_frame.h"
#include "results/series/time_steps.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

using Made = Result<MeasurementCharts::ValuePtr>;

Made made(MeasuredChart chart) { return std::make_shared<const MeasuredChart>(std::move(chart)); }

// Returns the interpolation of the view in focus if it shows the series, else of another view that does.
Interpolation interpolationOf(const Workspace& workspace, const SeriesKey& series) {
  const std::vector<ViewId> views = focusFirst(workspace, viewsOnScreen(workspace));
  const auto found = std::ranges::find_if(views, [&](ViewId id) {
    return workspace.view(id).series == series && isFlat(workspace.view(id).kind);
  });
  return found != views.end() && flatLookOf(workspace.view(*found)).nearest ? Interpolation::nearest
                                                                            : Interpolation::linear;
}

// Returns the mean of a region at a time point. Nothing if it contains no voxel, has another unit, or cannot
// be read.
std::optional<double> meanIn(const TimeStep& step, const ChartKey& key, const Job& job) {
  const std::optional<double> factor = factorTo(key.scale.unit, step);
  if (!factor) return {};
  const VolumePtr volume = volumeOf(step, job.progress(), job.cancel());
  if (!volume) return {};
  const auto values = regionValues(key.shape, *volume);
  return values ? std::optional(values->mean * *factor) : std::nullopt;
}

Made chartOverTime(const ChartKey& key, const TimeSteps& steps, const Job& job) {
  std::vector<std::optional<double>> means;
  for (const TimeStep& step : steps.all) {
    if (job.cancelled()) break;
    means.push_back(meanIn(step, key, job));
  }
  return made(timeChart(steps.axis, means, key.scale.unit));
}

Made chartOf(const ChartKey& key) {
  if (key.frame && key.frame->colour()) return Error{tr("Colours have no values.").toStdString()};
  const Volume& volume = *key.values->volume;
  const Shape shape = key.frame ? inSliceSpace(key.shape, volume.geometry()) : key.shape;
  if (key.kind == ChartKind::histogram)
    return made(histogramChart(shape, volume, key.scale, key.frame ? tr("Pixels") : tr("Voxels")));
  const Result<Measured> length = key.frame ? measureOnFrame(key.shape, pixelsOf(*key.frame), key.scale.unit)
                                            : measure(key.shape, volume, key.scale.unit);
  if (!length) return length.error();
  return made(profileChart(shape.points, volume, key.scale, key.interpolation, *length));
}

bool isRead(const TimeSteps& steps) {
  return std::ranges::any_of(steps.all, [](const TimeStep& step) { return !step.volume; });
}

}  // namespace

std::optional<ChartKey> chartKeyOf(const Session& session, FrameService& frames,
                                   const Measurement& measurement, ChartKind kind) {
  const Workspace& workspace = session.workspace();
  ChartKey key{measurement.series, measurement.shape, kind, interpolationOf(workspace, measurement.series)};
  if (!measurement.shape.frame) {
    key.values = session.seriesNamed(measurement.series);
  } else if (const auto state = workspace.series.find(measurement.series); state != workspace.series.end()) {
    const auto index = frameMeant(*state->second.series, *measurement.shape.frame);
    key.frame = index ? frames.find({measurement.series, *index}) : nullptr;
    if (key.frame) key.values = key.frame->slice;
  }
  if (!key.values) return {};
  key.shape.name.clear();
  key.scale = shownScale(key.values->series);
  if (kind == ChartKind::overTime)
    for (const Series* step : timePointsOf(workspace, measurement.series)) key.steps.push_back(keyOf(*step));
  return key;
}

MeasurementCharts::Rule measurementChartsRule(const Session& session,
                                              std::function<std::optional<ChartKey>()> wanted) {
  return {.wanted =
              [wanted = std::move(wanted)] {
                const std::optional<ChartKey> key = wanted();
                return key ? std::vector{*key} : std::vector<ChartKey>();
              },
          .work = [&session](const ChartKey& key, std::size_t) -> MeasurementCharts::Work {
            if (key.kind != ChartKind::overTime) return [key](const Job&) { return chartOf(key); };
            return [key, steps = timeStepsOf(session, key.series)](const Job& job) {
              return chartOverTime(key, steps, job);
            };
          },
          .name =
              [&session](const ChartKey& key) {
                const bool isLong =
                    key.kind == ChartKind::overTime && isRead(timeStepsOf(session, key.series));
                return isLong ? JobName(tr("Reading all time points"), seriesText(key.values->series))
                              : JobName();
              },
          .bytes = [](const MeasuredChart&) { return std::size_t(0); },
          .areVersions = [](const ChartKey&, const ChartKey&) { return true; },
          .lacksMemory = outOfMemory,
          .wasCancelled =
              tr("Reading was cancelled. Choose the measurement again to read the rest.").toStdString()};
}

TimeSteps timeStepsOf(const Session& session, const SeriesKey& series) {
  TimeSteps steps = timeStepsOf(timePointsOf(session.workspace(), series), shownPetUnit());
  for (TimeStep& step : steps.all)
    if (const LoadedSeriesPtr loaded = session.seriesNamed(keyOf(step.series))) step.volume = loaded->volume;
  return steps;
}

}  // namespace volumen
