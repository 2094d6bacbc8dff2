#include "ui/workspace/made_tissue.h"

#include <algorithm>
#include <utility>

#include "ui/workspace/segments.h"
#include "viewer/plan/facts.h"

namespace volumen {

std::vector<int> numbersShown(const SegmentMap& map) {
  std::vector<int> numbers;
  for (const Segment& segment : map.segments)
    if (segment.visible) numbers.push_back(segment.number);
  return numbers;
}

std::optional<MadeTissue> tissueWanted(const SegmentMap* map, const LoadedSeriesPtr& series) {
  if (!map || !series || map->tissue.where == TissueShown::Where::everywhere ||
      !isOn(*map, series->volume->geometry()))
    return {};
  return MadeTissue{series, map->labels, numbersShown(*map), map->tissue};
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
