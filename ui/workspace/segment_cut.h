#pragma once

#include "ui/data/series_key.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// What is to be taken from the current segment of a series: drawn around in 3D, or in a slice.
struct SegmentCut {
  SeriesKey series;
  Lasso lasso{};         ///< in a slice parallel, from a place of its plane
  bool inSlice = false;  ///< where the depth can be limited
  bool onFrame = false;  ///< a picture that is no slice of a volume: it has no lasso
};

}  // namespace volumen
