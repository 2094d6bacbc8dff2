// Session's data for 3D views: surfaces of segments, and volumes of which only some tissue is shown.
#include <algorithm>
#include <utility>

#include "ui/workspace/segments.h"
#include "ui/workspace/session.h"

namespace volumen {

std::vector<SegmentInScene> Session::segmentsDrawn(ViewId view) const {
  std::vector<SegmentInScene> drawn;
  const LoadedSeriesPtr series = seriesOf(view);
  if (!series) return drawn;
  const VoxelGeometry& grid = series->volume->geometry();
  for (const SegmentMap* map : segmentMapsOf(workspace_, workspace_.view(view).series)) {
    if (!isOn(*map, grid)) continue;
    for (const Segment* segment : segmentsIn3d(*map)) {
      const auto made = std::ranges::find_if(surfaces_, [&](const MadeSurface& s) {
        return s.series == map->series && s.map == map->number && s.number == segment->number;
      });
      if (made != surfaces_.end() && made->field && made->field->geometry == grid)
        drawn.push_back({segment, made->field});
    }
  }
  return drawn;
}

std::vector<SegmentNotDrawn> Session::segmentsNotDrawn(ViewId view) const {
  std::vector<SegmentNotDrawn> notDrawn;
  for (const SegmentMap* map : segmentMapsOf(workspace_, workspace_.view(view).series))
    for (const Segment* segment : segmentsIn3d(*map))
      for (const MadeSurface& made : surfaces_) {
        const bool isOfIt = made.series == map->series && made.map == map->number &&
                            made.number == segment->number && made.labels == map->labels;
        if (isOfIt && !made.field) notDrawn.push_back({segment, made.whyNot});
      }
  return notDrawn;
}

Scene Session::drawnScene(ViewId view) const {
  Scene scene = sceneOf(view);
  if (const MadeTissue* tissue = tissueDrawn(view)) {
    const LoadedSeries& whole = *tissue->of;
    scene = drawnAsTheWhole(std::move(scene), whole.window, whole.valueSpread, whole.volume->geometry());
  }
  for (const SegmentInScene& drawn : segmentsDrawn(view))
    scene.segments.push_back(surfaceOf(*drawn.segment, drawn.field));
  return scene;
}

const MadeTissue* Session::tissueDrawn(ViewId view) const {
  const LoadedSeriesPtr series = seriesOf(view);
  if (!series || !showsScene(workspace_.view(view).kind)) return nullptr;
  const auto made = std::ranges::find_if(
      tissues_, [&](const MadeTissue& tissue) { return areOneSeries(tissue.of, series); });
  if (made == tissues_.end() || !made->left || made->left == made->of) return nullptr;
  if (made->segments.empty() && preferences_.tableIn3d) return nullptr;
  return made->left->volume->geometry() == series->volume->geometry() ? &*made : nullptr;
}

LoadedSeriesPtr Session::drawnSeries(ViewId view) const {
  const MadeTissue* tissue = tissueDrawn(view);
  return tissue ? tissue->left : seriesOf(view);
}

void Session::takeTissue(MadeTissue made) {
  std::erase_if(tissues_, [&](const MadeTissue& before) { return areOneSeries(before.of, made.of); });
  if (made.left) pool_->watch(made.left->volume);
  tissues_.push_back(std::move(made));
  setWorkspace(workspace_);
}

void Session::takeSurfaces(std::vector<MadeSurface> made) {
  for (MadeSurface& surface : made) {
    std::erase_if(surfaces_, [&](const MadeSurface& before) { return before.isOfSame(surface); });
    surfaces_.push_back(std::move(surface));
  }
  setWorkspace(workspace_);
}

bool Session::dropHiddenSurfaces() {
  const auto isHidden = [&](const MadeSurface& surface) {
    const SegmentMap* map = segmentMapOf(workspace_, surface.series, surface.map);
    if (!surface.field || !map) return false;
    const std::vector<const Segment*> drawn = segmentsIn3d(*map);
    return std::ranges::find(drawn, surface.number, &Segment::number) == drawn.end();
  };
  return std::erase_if(surfaces_, isHidden) > 0;
}

void Session::dropUndrawn() {
  std::erase_if(surfaces_, [&](const MadeSurface& s) { return !isOfSegmentOnScreen(s, workspace_); });
  std::erase_if(tissues_, [&](const MadeTissue& t) { return !isTissueOnScreen(t, workspace_); });
}

}  // namespace volumen
