#include "results/segments/tissue.h"

#include <algorithm>
#include <utility>

#include "results/segments/segments.h"
#include "viewer/plan/facts.h"

namespace volumen {

std::size_t bytesBesideVolumes(const TissueVolume& tissue) {
  std::size_t words = 0;
  if (tissue.voxels) words += tissue.voxels->words().size();
  if (tissue.patient && tissue.patient != tissue.voxels) words += tissue.patient->words().size();
  return words * sizeof(std::uint64_t);
}

std::vector<ChosenSegments> segmentsShownOf(const std::vector<const SegmentMap*>& maps,
                                            const VoxelGeometry& grid) {
  std::vector<ChosenSegments> all;
  for (const SegmentMap* map : maps) {
    if (!isOn(*map, grid)) continue;
    ChosenSegments& chosen = all.emplace_back(ChosenSegments{map->labels, {}});
    for (const Segment& segment : map->segments)
      if (segment.visible) chosen.numbers.push_back(segment.number);
  }
  return all;
}

std::optional<TissueKey> tissueWanted(const std::vector<const SegmentMap*>& maps,
                                      const LoadedSeriesPtr& series, bool withoutTable) {
  if (!series) return {};
  TissueKey wanted{series, {}, {}, withoutTable};
  if (!maps.empty() && maps.front()->tissue.where != TissueShown::Where::everywhere)
    wanted.segments = segmentsShownOf(maps, series->volume->geometry());
  if (!wanted.segments.empty()) wanted.shown = maps.front()->tissue;
  return wanted.segments.empty() && !withoutTable ? std::nullopt : std::optional(wanted);
}

Scene drawnAsTheWhole(Scene scene, const Window& window, double valueSpread, const VoxelGeometry& geometry) {
  if (!scene.window) scene.window = window;
  if (!scene.shading.gradientFloor) scene.shading.gradientFloor = defaultGradientFloor(valueSpread, geometry);
  return scene;
}

}  // namespace volumen
