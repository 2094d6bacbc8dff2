#include "viewer/segment/tissue_shown.h"

#include <utility>

#include "viewer/segment/morphology.h"

namespace volumen {

BitMask tissueVoxels(std::span<const ChosenSegments> maps, const TissueShown& shown,
                     const CancelToken& cancel) {
  using enum TissueShown::Where;
  BitMask voxels(maps.front().labels->geometry());
  if (shown.where == everywhere) return inverted(std::move(voxels));
  for (const ChosenSegments& map : maps)
    for (const int segment : map.numbers)
      voxels = united(std::move(voxels), maskOf(*map.labels, std::uint8_t(segment)));
  if (shown.marginMm > 0) voxels = grown(voxels, shown.marginMm, cancel);
  return shown.where == outside ? inverted(std::move(voxels)) : voxels;
}

}  // namespace volumen
