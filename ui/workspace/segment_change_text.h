#pragma once

#include <QString>

#include "results/segments/segment_map.h"

namespace volumen {

/// Returns the side effects of a change of a map: voxels taken from other segments, and hidden segments that
/// gained voxels. "Bone took 1,234 voxels (1.23 ml) of Liver." Empty if there are none. Both maps have
/// labels. Slow if many bricks changed.
QString changeText(const SegmentMap& before, const SegmentMap& after);

}  // namespace volumen
