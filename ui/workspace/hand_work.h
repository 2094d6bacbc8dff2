#pragma once

#include <QString>
#include <utility>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// What a person made by hand, on series that are shown and on closed ones.
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

/// What of it is not among what was saved; the numbers of measurements count for nothing.
HandWork without(HandWork work, const HandWork& saved);

/// Both.
HandWork operator+(HandWork a, const HandWork& b);

/// "2 measurements, 1 key image"; empty where there is none.
QString workText(const HandWork& work);

}  // namespace volumen
