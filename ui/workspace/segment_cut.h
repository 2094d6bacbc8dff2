#pragma once

#include "ui/data/series_key.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// A cut from the current segment of a series, outlined in 3D or in a slice.
struct SegmentCut {
  SeriesKey series;
  Lasso lasso{};         ///< in a slice: parallel, from a point of its plane
  bool inSlice = false;  ///< in a slice, where the depth can be limited
  bool onFrame = false;  ///< on a picture that is no slice of a volume: there is no lasso
};

}  // namespace volumen
