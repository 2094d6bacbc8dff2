#include "ui/controller/segment_time_values.h"

#include "viewer/segment/numbers.h"

namespace volumen {

namespace {

// Returns nothing if the volume is null or of another size.
std::optional<StepValues> valuesOfStep(const VolumePtr& volume, const BitMask& mask, double factor) {
  if (!volume || volume->size() != mask.size()) return {};
  const SegmentValues values = valuesIn(mask, *volume);
  if (values.voxels == 0) return {};
  return StepValues{values.mean * factor, values.sd * factor, values.min * factor, values.max * factor};
}

}  // namespace

SegmentsOverTime segmentsIn(const TimeSteps& steps, const std::vector<SegmentMap>& maps,
                            const std::string& unit, const Progress& progress, const CancelToken& cancel) {
  SegmentsOverTime found{steps.axis, unit, {}};
  for (const SegmentMap& map : maps) found.segments.resize(found.segments.size() + map.segments.size());
  for (std::size_t n = 0; n < steps.all.size(); ++n) {
    if (cancel.cancelled()) break;
    if (progress) progress("measuring time points", n, steps.all.size());
    const std::optional<double> factor = factorTo(unit, steps.all[n]);
    const VolumePtr volume = factor ? volumeOf(steps.all[n], progress, cancel) : nullptr;
    std::size_t segment = 0;
    for (const SegmentMap& map : maps)
      for (const Segment& each : map.segments)
        found.segments[segment++].push_back(
            valuesOfStep(volume, maskOf(*map.labels, std::uint8_t(each.number)), factor.value_or(1)));
  }
  return found;
}

}  // namespace volumen
