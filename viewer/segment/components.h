#pragma once

#include "viewer/segment/dense_labels.h"

namespace volumen {

/// What of label 1 is its largest part of voxels that share faces; of several as large the first in memory.
DenseLabels largestComponent(DenseLabels map);

}  // namespace volumen
