#pragma once

#include "ui/data/series_key.h"
#include "viewer/segment/brush.h"

namespace volumen {

/// A part of a stroke that paints or erases the current segment of a series. It is the first, a further one,
/// or the end, which paints nothing.
struct SegmentStroke {
  enum class Phase { begins, goesOn, ends };
  Phase phase = Phase::begins;
  SeriesKey series;
  VoxelSpans spans;  ///< on the grid of its volume
  bool erases = false;
  bool onFrame = false;  ///< on a picture that is no slice of a volume
};

}  // namespace volumen
