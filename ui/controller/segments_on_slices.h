#pragma once

#include <vector>

#include "results/segments/segment_map.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Series;

/// Returns the maps in the form that is written. They have labels.
std::vector<Segmented> segmentedOf(const std::vector<SegmentMap>& maps);

/// Returns the same with labels on the slices as acquired, if some of these are not drawn. The recorded steps
/// of a segment run again there. An Error names a file that cannot be read.
Result<std::vector<Segmented>> segmentedOnSlices(const std::vector<SegmentMap>& maps, const Series& series,
                                                 const CancelToken& cancel);

}  // namespace volumen
