#pragma once

#include <string>
#include <vector>

#include "ui/controller/time_steps.h"
#include "ui/workspace/segment_map.h"
#include "ui/workspace/segments_over_time.h"

namespace volumen {

/// Returns the values of all segments at each time point of their series, map after map. `unit` is the unit
/// of the values. Slow; a cancelled result is incomplete.
SegmentsOverTime segmentsIn(const TimeSteps& steps, const std::vector<SegmentMap>& maps,
                            const std::string& unit, const Progress& progress = {},
                            const CancelToken& cancel = {});

}  // namespace volumen
