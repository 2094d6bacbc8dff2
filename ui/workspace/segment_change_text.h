#pragma once

#include <QString>

#include "ui/workspace/segment_map.h"

namespace volumen {

/// What a change of a map did that its own segment does not show: voxels that segments took from others
/// ("Bone took 1,234 voxels (1.23 ml) of Liver."), and segments that got voxels while they are hidden. Empty:
/// neither. Both have labels. Takes time where many bricks changed.
QString changeText(const SegmentMap& before, const SegmentMap& after);

}  // namespace volumen
