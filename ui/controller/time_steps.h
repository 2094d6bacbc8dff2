#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/suv.h"
#include "ui/workspace/session.h"
#include "ui/workspace/time_point_text.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A step of a series, and its voxels where they are in memory.
struct TimeStep {
  Series series;
  VolumePtr volume{};
  ValueScale scale{};
};

/// The steps of a series, itself included, and where each stands.
struct TimeSteps {
  std::vector<TimeStep> all;
  StepAxis axis;
};
/// Of these, which are in order; none is in memory. Their scales: in `unit` of PET.
TimeSteps timeStepsOf(const std::vector<const Series*>& steps, PetUnit unit);
/// Of a series that the workspace knows, in the unit that is shown.
TimeSteps timeStepsOf(const Session& session, const SeriesKey& series);

/// What values of a step are times that to be in a unit; none: they are in another one, such as those of a
/// PET that lacks what its SUV takes.
std::optional<double> factorTo(const std::string& unit, const TimeStep& step);

/// The volume of a step, read where it is not in memory; null: it cannot be read. Takes its time.
VolumePtr volumeOf(const TimeStep& step, const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
