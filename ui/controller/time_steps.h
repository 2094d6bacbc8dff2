#pragma once

#include <vector>

#include "io/study/progress.h"
#include "ui/workspace/session.h"
#include "ui/workspace/time_point_text.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A step of a series, and its voxels where they are in memory.
struct TimeStep {
  Series series;
  VolumePtr volume{};
  double factor = 1;  ///< to what its values are shown in
};

/// The steps of a series, itself included, and where each stands.
struct TimeSteps {
  std::vector<TimeStep> all;
  StepAxis axis;
};
/// Of these, which are in order; none is in memory.
TimeSteps timeStepsOf(const std::vector<const Series*>& steps);
/// Of a series that the workspace knows.
TimeSteps timeStepsOf(const Session& session, const SeriesKey& series);

/// The volume of a step, read where it is not in memory; null: it cannot be read. Takes its time.
VolumePtr volumeOf(const TimeStep& step, const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
