#include "io/export/surfaces_to_write.h"

#include <cstdio>
#include <new>

#include "viewer/segment/occupancy.h"

namespace volumen {

Result<SurfaceToWrite> surfaceToWrite(const Segmented& map, const Segment& segment, double reducedByMm,
                                      const CancelToken& cancel) try {
  const Error interrupted{"Interrupted; nothing was written."};
  SurfaceToWrite made{segment.label};
  const BitMask mask = maskOf(map.labels, std::uint8_t(segment.number));
  if (mask.empty()) return made;
  Result<Surface> all = volumePreservingSurface(occupancyOf(mask, surfaceSigma, cancel), cancel);
  if (!all) return cancel.cancelled() ? interrupted : all.error();
  if (reducedByMm > 0) {
    made.surface = reduced(*all, reducedByMm, cancel);
    made.before = {all->triangles.size(), volumeOf(*all) / 1000,
                   deviation(made.surface, *all, cancel).largest};
  } else {
    made.surface = std::move(*all);
  }
  made.voxelsMl = double(mask.count()) * mask.geometry().voxelVolume() / 1000;
  made.insideMl = volumeOf(made.surface) / 1000;
  made.areaCm2 = areaOf(made.surface) / 100;
  if (cancel.cancelled()) return interrupted;
  return made;
} catch (const std::bad_alloc&) {
  return Error{"There is not enough memory for the surface of " + segment.label + "."};
}

Result<std::vector<SurfaceToWrite>> surfacesToWrite(std::span<const Segmented> maps, double reducedByMm,
                                                    const CancelToken& cancel) {
  std::vector<SurfaceToWrite> all;
  for (const Segmented& map : maps)
    for (const Segment& segment : map.segments) {
      auto made = surfaceToWrite(map, segment, reducedByMm, cancel);
      if (!made) return made.error();
      all.push_back(std::move(*made));
    }
  return all;
}

std::vector<std::string> toldOf(const SurfaceToWrite& surface) {
  char text[200];
  std::snprintf(text, sizeof text, "%zu triangles, %.4g ml inside (%.4g ml by voxels), %.4g cm^2.",
                surface.surface.triangles.size(), surface.insideMl, surface.voxelsMl, surface.areaCm2);
  std::vector<std::string> told{text};
  if (surface.before) {
    std::snprintf(text, sizeof text, "reduced from %zu triangles and %.4g ml, at most %.2g mm off them.",
                  surface.before->triangles, surface.before->insideMl, surface.before->offMm);
    told.emplace_back(text);
  }
  return told;
}

}  // namespace volumen
