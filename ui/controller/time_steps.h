#pragma once

#include <vector>

#include "ui/document/jobs.h"
#include "ui/workspace/session.h"
#include "ui/workspace/time_point_text.h"

namespace volumen {

/// A step of a series, and its voxels where they are in memory.
struct TimeStep {
  Series series;
  LoadedSeriesPtr loaded;
  double factor = 1;  ///< to what its values are shown in
};

/// The steps of a series that the workspace knows, itself included, and where each stands.
struct TimeSteps {
  std::vector<TimeStep> all;
  StepAxis axis;
};
TimeSteps timeStepsOf(const Session& session, const SeriesKey& series);

/// The volume of a step, read where it is not in memory; null: it cannot be read. For jobs.
VolumePtr volumeOf(const TimeStep& step, const Job& job);

}  // namespace volumen
