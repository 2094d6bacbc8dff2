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
  double factor = 1;  ///< to the unit that they are told in
};

/// The steps of a series, itself included, and where each stands.
struct TimeSteps {
  std::vector<TimeStep> all;
  StepAxis axis;
};
/// Of these, which are in order; none is in memory. Their factors: to `unit` of PET.
TimeSteps timeStepsOf(const std::vector<const Series*>& steps, PetUnit unit);
/// Of a series that the workspace knows, in the unit that is shown.
TimeSteps timeStepsOf(const Session& session, const SeriesKey& series);

/// The volume of a step, read where it is not in memory; null: it cannot be read. Takes its time.
VolumePtr volumeOf(const TimeStep& step, const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
