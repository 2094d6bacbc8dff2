#pragma once

#include <optional>

#include "ui/controller/frame_service.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/measurement_chart.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Makes the chart of one measurement on a worker thread. Time points that are not in memory are read for it
/// one after another, as a job that can be cancelled.
class ChartJobs : public QObject {
  Q_OBJECT
 public:
  ChartJobs(const Session& session, FrameService& frames, Jobs& jobs, QObject* parent = nullptr);

  /// Requests a chart; ready() delivers it unless another is requested first. Does nothing if a chart of the
  /// same shape, voxels and unit exists or is in progress. Returns false and drops the chart if the
  /// measurement's series or frame is not in memory.
  bool request(const Measurement& measurement, ChartKind kind);
  /// Drops the chart.
  void drop();

 Q_SIGNALS:
  void ready(int measurement, const volumen::MeasuredChart& chart);

 private:
  // Everything a chart depends on; equal values make equal charts.
  struct Wanted {
    int measurement = 0;
    SeriesKey series;
    Shape shape;
    ChartKind kind = ChartKind::profile;
    Interpolation interpolation = Interpolation::linear;
    std::vector<SeriesKey> steps;
    ValueScale scale;
    bool operator==(const Wanted&) const = default;
  };
  // The source of the values and the space of the shape.
  struct Ground {
    LoadedSeriesPtr series;
    LoadedFramePtr frame;  // null for a volume
  };
  std::optional<Ground> groundOf(const Measurement& measurement) const;
  Interpolation interpolationOf(const SeriesKey& series) const;
  void start(const Wanted& wanted, const Ground& ground);
  void startOverTime(const Wanted& wanted);

  const Session& session_;
  FrameService& frames_;
  std::optional<Wanted> wanted_;        // done or in progress
  std::weak_ptr<const Volume> volume_;  // source of the values
  JobLane lane_;
};

}  // namespace volumen
