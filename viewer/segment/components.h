#pragma once

#include "viewer/segment/label_map.h"

namespace volumen {

/// What of label 1 is its largest part of voxels that share faces; of several as large the first in memory.
LabelMap largestComponent(LabelMap map);

}  // namespace volumen
