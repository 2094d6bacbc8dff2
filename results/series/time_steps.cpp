#include "results/series/time_steps.h"

#include "io/load.h"

namespace volumen {

TimeSteps timeStepsOf(const std::vector<const Series*>& steps, PetUnit unit) {
  TimeSteps made{{}, stepAxisOf(steps)};
  for (const Series* step : steps) made.all.push_back({*step, nullptr, valueScale(*step, unit)});
  return made;
}

std::optional<double> factorTo(const std::string& unit, const TimeStep& step) {
  return step.scale.unit == unit ? std::optional(step.scale.factor) : std::nullopt;
}

VolumePtr volumeOf(const TimeStep& step, const Progress& progress, const CancelToken& cancel) {
  if (step.volume) return step.volume;
  const Result<Loaded> loaded = loadSeries(step.series, progress, cancel);
  return loaded ? loaded->drawn : nullptr;
}

}  // namespace volumen
