#pragma once

#include <vector>

#include "ui/workspace/segment_map.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Series;

/// As they are written. The maps have labels.
std::vector<Segmented> segmentedOf(const std::vector<SegmentMap>& maps);

/// The same with labels on the slices of the series as acquired, where some of these are not drawn: the steps
/// that made a segment are done again there. An Error names a file that cannot be read.
Result<std::vector<Segmented>> segmentedOnSlices(const std::vector<SegmentMap>& maps, const Series& series,
                                                 const CancelToken& cancel);

}  // namespace volumen
