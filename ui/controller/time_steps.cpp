#include "ui/controller/time_steps.h"

#include "io/load.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/value_text.h"

namespace volumen {

TimeSteps timeStepsOf(const Session& session, const SeriesKey& series) {
  const std::vector<const Series*> known = timePointsOf(session.workspace(), series);
  TimeSteps steps{{}, stepAxisOf(known)};
  for (const Series* step : known)
    steps.all.push_back({*step, session.seriesNamed(keyOf(*step)), shownScale(*step).factor});
  return steps;
}

VolumePtr volumeOf(const TimeStep& step, const Job& job) {
  if (step.loaded) return step.loaded->volume;
  const Result<Loaded> loaded = loadSeries(step.series, job.progress(), job.cancel());
  return loaded ? loaded->drawn : nullptr;
}

}  // namespace volumen
