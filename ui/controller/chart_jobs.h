#pragma once

#include <optional>

#include "ui/controller/frame_service.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/measurement_chart.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The chart of one measurement, made on a worker thread; steps of its series that are not in memory are read
/// for it, one after the other, as a job that can be cancelled.
class ChartJobs : public QObject {
  Q_OBJECT
 public:
  ChartJobs(const Session& session, FrameService& frames, Jobs& jobs, QObject* parent = nullptr);

  /// Ends in ready(), unless another one is asked for before. Nothing where it is the one that is there or
  /// under way, of the same shape, voxels and unit. False: what it was drawn on is not in memory, and no
  /// chart is wanted any more.
  bool request(const Measurement& measurement, ChartKind kind);
  /// No chart is wanted any more.
  void drop();

 Q_SIGNALS:
  void ready(int measurement, const volumen::MeasuredChart& chart);

 private:
  // What a chart is made of; equal ones make equal charts.
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
  // On what, in whose space.
  struct Ground {
    LoadedSeriesPtr series;
    LoadedFramePtr frame;  // null: a volume
  };
  std::optional<Ground> groundOf(const Measurement& measurement) const;
  Interpolation interpolationOf(const SeriesKey& series) const;
  void start(const Wanted& wanted, const Ground& ground);
  void startOverTime(const Wanted& wanted);

  const Session& session_;
  FrameService& frames_;
  std::optional<Wanted> wanted_;        // there, or under way
  std::weak_ptr<const Volume> volume_;  // whose voxels
  JobLane lane_;
};

}  // namespace volumen
