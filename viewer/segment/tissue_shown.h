#pragma once

#include <memory>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The region where tissue of a volume is shown: everywhere, only inside segments, or only outside them.
struct TissueShown {
  enum class Where { everywhere, inside, outside };

  Where where = Where::everywhere;
  double marginMm = 0;  ///< Margin by which segments are grown (grown()); 0 to mostTissueMarginMm
  bool operator==(const TissueShown&) const = default;
};
inline constexpr double mostTissueMarginMm = 50;

/// Segments of a label map, by label.
struct ChosenSegments {
  std::shared_ptr<const LabelMap> labels;
  std::vector<int> numbers;
  /// Compares the map by identity, not by content.
  bool operator==(const ChosenSegments&) const = default;
};

/// Returns the voxels where tissue is shown, for segments of one or several maps on one grid. Without
/// segments nothing is inside. Runs on all cores. The result is incomplete if cancelled.
BitMask tissueVoxels(std::span<const ChosenSegments> maps, const TissueShown& shown,
                     const CancelToken& cancel = {});

}  // namespace volumen
