#include "io/export/surfaces_to_write.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <utility>

#include "viewer/segment/occupancy.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/surface_mended.h"

namespace volumen {

namespace {

void countShells(SurfaceToWrite& made) {
  const std::vector<double> volumes = shellVolumes(made.surface);
  double solid = 0;
  for (const double volume : volumes) solid += std::max(volume, 0.0);
  made.shells = volumes.size();
  made.cavities = std::size_t(std::ranges::count_if(volumes, [](double volume) { return volume < 0; }));
  if (solid > 0) made.largestShare = volumes.front() / solid;
}

// Returns "1 closed shell.", or "51 closed shells, 2 of them around cavities; the largest has 98.2 % of the
// volume."
std::string shellsText(const SurfaceToWrite& surface) {
  if (surface.shells == 1) return "1 closed shell.";
  std::string text = std::to_string(surface.shells) + " closed shells";
  if (surface.cavities > 0) text += ", " + std::to_string(surface.cavities) + " of them around cavities";
  if (surface.shells - surface.cavities > 1) {
    char largest[60];
    std::snprintf(largest, sizeof largest, "; the largest has %.3g %% of the volume",
                  100 * surface.largestShare);
    text += largest;
  }
  return text + ".";
}

}  // namespace

Result<SurfaceToWrite> surfaceToWrite(const Segmented& map, const Segment& segment, double reducedByMm,
                                      const CancelToken& cancel) try {
  const Error interrupted{"Interrupted; nothing was written."};
  SurfaceToWrite made{segment.label};
  const BitMask mask = maskOf(map.labels, std::uint8_t(segment.number));
  if (mask.empty()) return made;
  const OccupancyField field = occupancyOf(mask, surfaceSigma, cancel);
  Result<Surface> all = volumePreservingSurface(field, cancel);
  if (!all) return cancel.cancelled() ? interrupted : all.error();
  *all = mended(std::move(*all), field, cancel);
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
  countShells(made);
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

Segmented withLargestParts(const Segmented& map, const CancelToken& cancel) {
  Segmented largest = map;
  for (const Segment& segment : map.segments) {
    const auto number = std::uint8_t(segment.number);
    const Parts parts(maskOf(map.labels, number), Neighbours::faces, cancel);
    if (cancel.cancelled()) return largest;
    if (parts.count() > 1) largest.labels = withLabel(largest.labels, number, parts.largest());
  }
  return largest;
}

std::vector<std::string> toldOf(const SurfaceToWrite& surface) {
  char text[200];
  std::snprintf(text, sizeof text, "%zu triangles, %.4g ml inside (%.4g ml by voxels), %.4g cm^2.",
                surface.surface.triangles.size(), surface.insideMl, surface.voxelsMl, surface.areaCm2);
  std::vector<std::string> told{text, shellsText(surface)};
  if (surface.before) {
    std::snprintf(text, sizeof text, "reduced from %zu triangles and %.4g ml, at most %.2g mm off them.",
                  surface.before->triangles, surface.before->insideMl, surface.before->offMm);
    told.emplace_back(text);
  }
  return told;
}

}  // namespace volumen
