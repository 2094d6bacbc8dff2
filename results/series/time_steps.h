#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/series.h"
#include "io/study/suv.h"
#include "results/series/time_points.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A time point of a series, and its voxels if they are in memory.
struct TimeStep {
  Series series;
  VolumePtr volume{};
  ValueScale scale{};
};

/// The time points of a series including itself, and their positions on the axis.
struct TimeSteps {
  std::vector<TimeStep> all;
  StepAxis axis;
};
/// Returns these time points, which are in order; none is in memory. Their scales are in `unit` for PET.
TimeSteps timeStepsOf(const std::vector<const Series*>& steps, PetUnit unit);

/// Returns the factor from stored values of a time point to `unit`. Returns nothing if they have another
/// unit, such as a PET without the data for SUV.
std::optional<double> factorTo(const std::string& unit, const TimeStep& step);

/// Returns the volume of a time point and reads it if needed; null if it cannot be read. Slow.
VolumePtr volumeOf(const TimeStep& step, const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
