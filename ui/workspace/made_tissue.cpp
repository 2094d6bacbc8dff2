#include "ui/workspace/made_tissue.h"

#include <algorithm>
#include <utility>

#include "ui/workspace/segments.h"
#include "viewer/plan/facts.h"

namespace volumen {

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
                                       const LoadedSeriesPtr& series) {
  if (maps.empty() || !series || maps.front()->tissue.where == TissueShown::Where::everywhere) return {};
  std::vector<ChosenSegments> shown = segmentsShownOf(maps, series->volume->geometry());
  if (shown.empty()) return {};
  return MadeTissue{series, std::move(shown), maps.front()->tissue};
}

bool isTissueOnScreen(const MadeTissue& tissue, const Workspace& workspace) {
  const SeriesKey series = keyOf(tissue.of->series);
  const SegmentMap* map = segmentMapOf(workspace, series);
  if (!map || map->tissue.where == TissueShown::Where::everywhere) return false;
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
