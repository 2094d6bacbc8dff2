#pragma once

#include <span>

#include "viewer/segment/bit_mask.h"
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

/// The voxels where it is shown, for the segments that have these labels; without segments nothing is inside.
/// On all cores. A cancelled one is half done.
BitMask tissueVoxels(const LabelMap& labels, std::span<const int> segments, const TissueShown& shown,
                     const CancelToken& cancel = {});

}  // namespace volumen
