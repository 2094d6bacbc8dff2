#include "ui/controller/chart_jobs.h"

#include <algorithm>

#include "ui/controller/time_steps.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/text.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/value_text.h"

namespace volumen {

namespace {

// Returns the mean of a region at a time point. Nothing if it contains no voxel, has another unit, or cannot
// be read.
std::optional<double> meanIn(const TimeStep& step, const Shape& region, const std::string& unit,
                             const Job& job) {
  const std::optional<double> factor = factorTo(unit, step);
  if (!factor) return {};
  const VolumePtr volume = volumeOf(step, job.progress(), job.cancel());
  if (!volume) return {};
  const auto values = regionValues(region, *volume);
  return values ? std::optional(values->mean * *factor) : std::nullopt;
}

MeasuredChart colourHasNone() {
  MeasuredChart chart;
  chart.problem = ChartJobs::tr("Colours have no values.");
  return chart;
}

}  // namespace

ChartJobs::ChartJobs(const Session& session, FrameService& frames, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), frames_(frames), lane_(&jobs) {}

std::optional<ChartJobs::Ground> ChartJobs::groundOf(const Measurement& measurement) const {
  if (!measurement.shape.frame) {
    const LoadedSeriesPtr series = session_.seriesNamed(measurement.series);
    return series ? std::optional(Ground{series, nullptr}) : std::nullopt;
  }
  const auto& all = session_.workspace().series;
  const auto state = all.find(measurement.series);
  if (state == all.end()) return {};
  const auto index = frameMeant(*state->second.series, *measurement.shape.frame);
  const LoadedFramePtr frame = index ? frames_.find({measurement.series, *index}) : nullptr;
  return frame ? std::optional(Ground{frame->slice, frame}) : std::nullopt;
}

// Returns the interpolation of the view in focus if it shows the series, else of another view that does.
Interpolation ChartJobs::interpolationOf(const SeriesKey& series) const {
  const Workspace& workspace = session_.workspace();
  std::vector<ViewId> views = viewsOnScreen(workspace);
  std::ranges::stable_partition(views, [&](ViewId id) { return id == workspace.focus; });
  const auto found = std::ranges::find_if(views, [&](ViewId id) {
    return workspace.view(id).series == series && isFlat(workspace.view(id).kind);
  });
  return found != views.end() && flatLookOf(workspace.view(*found)).nearest ? Interpolation::nearest
                                                                            : Interpolation::linear;
}

bool ChartJobs::request(const Measurement& measurement, ChartKind kind) {
  const std::optional<Ground> ground = groundOf(measurement);
  if (!ground) {
    drop();
    return false;
  }
  Wanted wanted{measurement.id,
                measurement.series,
                measurement.shape,
                kind,
                interpolationOf(measurement.series),
                {},
                shownScale(ground->series->series)};
  wanted.shape.name.clear();
  if (kind == ChartKind::overTime)
    for (const Series* step : timePointsOf(session_.workspace(), measurement.series))
      wanted.steps.push_back(keyOf(*step));
  const VolumePtr& volume = ground->series->volume;
  if (wanted_ == wanted && volume_.lock() == volume) return true;
  lane_.giveUpAll();
  wanted_ = wanted;
  volume_ = volume;
  if (kind == ChartKind::overTime)
    startOverTime(wanted);
  else
    start(wanted, *ground);
  return true;
}

void ChartJobs::drop() {
  lane_.giveUpAll();
  wanted_.reset();
}

void ChartJobs::start(const Wanted& wanted, const Ground& ground) {
  if (ground.frame && ground.frame->colour()) return Q_EMIT ready(wanted.measurement, colourHasNone());
  lane_.run(
      {},
      [wanted, held = ground.series, frame = ground.frame, voxels = tr("Voxels"),
       pixels = tr("Pixels")](const Job&) -> MeasuredChart {
        const Volume& volume = *held->volume;
        const Shape shape = frame ? inSliceSpace(wanted.shape, volume.geometry()) : wanted.shape;
        if (wanted.kind == ChartKind::histogram)
          return histogramChart(shape, volume, wanted.scale, frame ? pixels : voxels);
        const Result<Measured> length =
            frame ? measureOnFrame(wanted.shape, pixelsOf(*frame), wanted.scale.unit)
                  : measure(wanted.shape, volume, wanted.scale.unit);
        if (length) return profileChart(shape.points, volume, wanted.scale, wanted.interpolation, *length);
        MeasuredChart none;
        none.problem = QString::fromStdString(length.message());
        return none;
      },
      [this, id = wanted.measurement](const MeasuredChart& chart) { Q_EMIT ready(id, chart); });
}

void ChartJobs::startOverTime(const Wanted& wanted) {
  TimeSteps steps = timeStepsOf(session_, wanted.series);
  const bool isRead = std::ranges::any_of(steps.all, [](const TimeStep& step) { return !step.volume; });
  const JobName name =
      isRead ? JobName(tr("Reading all time points"), seriesText(steps.all.front().series)) : JobName();
  lane_.run(
      name,
      [wanted, steps = std::move(steps)](const Job& job) {
        std::vector<std::optional<double>> means;
        for (const TimeStep& step : steps.all) {
          if (job.cancelled()) break;
          means.push_back(meanIn(step, wanted.shape, wanted.scale.unit, job));
        }
        return timeChart(steps.axis, means, wanted.scale.unit);
      },
      [this, id = wanted.measurement](const MeasuredChart& chart) { Q_EMIT ready(id, chart); },
      [this, id = wanted.measurement] {
        MeasuredChart none;
        none.problem = tr("Reading was cancelled. Choose the measurement again to read the rest.");
        Q_EMIT ready(id, none);
      });
}

}  // namespace volumen
