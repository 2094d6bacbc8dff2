#include "viewer/segment/tissue_shown.h"

#include <utility>

#include "viewer/segment/morphology.h"

namespace volumen {

BitMask tissueVoxels(const LabelMap& labels, std::span<const int> segments, const TissueShown& shown,
                     const CancelToken& cancel) {
  using enum TissueShown::Where;
  BitMask voxels(labels.geometry());
  if (shown.where == everywhere) return inverted(std::move(voxels));
  for (const int segment : segments)
    voxels = united(std::move(voxels), maskOf(labels, std::uint8_t(segment)));
  if (shown.marginMm > 0) voxels = grown(voxels, shown.marginMm, cancel);
  return shown.where == outside ? inverted(std::move(voxels)) : voxels;
}

}  // namespace volumen
