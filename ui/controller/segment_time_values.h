#pragma once

#include <string>
#include <vector>

#include "ui/controller/time_steps.h"
#include "ui/workspace/segment_map.h"
#include "ui/workspace/segments_over_time.h"

namespace volumen {

/// The values of all segments, map after map, in each step of their series; `unit`: what the factors of the
/// steps lead to. Takes its time; a cancelled one is half done.
SegmentsOverTime segmentsIn(const TimeSteps& steps, const std::vector<SegmentMap>& maps,
                            const std::string& unit, const Progress& progress = {},
                            const CancelToken& cancel = {});

}  // namespace volumen
