#include "ui/workspace/made_tissue.h"

#include <algorithm>
#include <utility>

#include "ui/workspace/segments.h"
#include "viewer/plan/facts.h"

namespace volumen {

std::size_t bytesBesideVolumes(const MadeTissue& tissue) {
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

std::optional<MadeTissue> tissueWanted(const std::vector<const SegmentMap*>& maps,
                                       const LoadedSeriesPtr& series, bool withoutTable) {
  if (!series) return {};
  MadeTissue wanted{series, {}, {}};
  wanted.withoutTable = withoutTable;
  if (!maps.empty() && maps.front()->tissue.where != TissueShown::Where::everywhere)
    wanted.segments = segmentsShownOf(maps, series->volume->geometry());
  if (!wanted.segments.empty()) wanted.shown = maps.front()->tissue;
  return wanted.segments.empty() && !withoutTable ? std::nullopt : std::optional(wanted);
}

bool isTissueOnScreen(const MadeTissue& tissue, const Workspace& workspace) {
  const SeriesKey series = keyOf(tissue.of->series);
  const auto known = workspace.series.find(series);
  if (known == workspace.series.end()) return false;
  const SegmentMap* map = segmentMapOf(workspace, series);
  const bool isOfSegments = map && map->tissue.where != TissueShown::Where::everywhere;
  if (isOfSegments != !tissue.segments.empty()) return false;
  if (!isOfSegments && known->second.mask.tableRemoved) return false;
  return std::ranges::any_of(viewsOnScreen(workspace), [&](ViewId id) {
    const ViewState& view = workspace.view(id);
    return view.series == series && showsScene(view.kind);
  });
}

Scene drawnAsTheWhole(Scene scene, const Window& window, double valueSpread, const VoxelGeometry& geometry) {
  if (!scene.window) scene.window = window;
  if (!scene.shading.gradientFloor) scene.shading.gradientFloor = defaultGradientFloor(valueSpread, geometry);
  return scene;
}

}  // namespace volumen
