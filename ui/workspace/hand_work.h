#pragma once

#include <QString>
#include <utility>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Everything a person made by hand, on shown and on closed series.
struct HandWork {
  std::vector<Measurement> measurements;
  std::vector<KeyImage> keyImages;
  std::vector<std::pair<SeriesKey, Mask>> cuts;
  std::vector<SegmentMap> segmentMaps;

  bool empty() const {
    return measurements.empty() && keyImages.empty() && cuts.empty() && segmentMaps.empty();
  }
};

HandWork workIn(const Workspace& workspace);

/// Returns the work that is not in `saved`. Ignores the ids of measurements.
HandWork without(HandWork work, const HandWork& saved);

/// Returns both together.
HandWork operator+(HandWork a, const HandWork& b);

/// Returns "2 measurements, 1 key image", or an empty text.
QString workText(const HandWork& work);

}  // namespace volumen
