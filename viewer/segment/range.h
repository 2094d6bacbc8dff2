#pragma once

#include "viewer/segment/dense_labels.h"

namespace volumen {

/// Label 1 where range.low <= value <= range.high, real units, and the value is no padding; ends may be
/// infinite. On all cores.
DenseLabels labelRange(const Volume& volume, ValueRange range);

}  // namespace volumen
