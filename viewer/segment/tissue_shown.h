#pragma once

#include <memory>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Where a volume's own tissue is shown: everywhere, or only inside segments, or only outside them.
struct TissueShown {
  enum class Where { everywhere, inside, outside };

  Where where = Where::everywhere;
  double marginMm = 0;  ///< that the segments are grown by, as grown() does; 0 to mostTissueMarginMm
  bool operator==(const TissueShown&) const = default;
};
inline constexpr double mostTissueMarginMm = 50;

/// Segments of a map, by their labels.
struct ChosenSegments {
  std::shared_ptr<const LabelMap> labels;
  std::vector<int> numbers;
  /// Of one map, not only of equal ones.
  bool operator==(const ChosenSegments&) const = default;
};

/// The voxels where it is shown, for segments of one or several maps of one grid; without segments nothing is
/// inside. On all cores. A cancelled one is half done.
BitMask tissueVoxels(std::span<const ChosenSegments> maps, const TissueShown& shown,
                     const CancelToken& cancel = {});

}  // namespace volumen
