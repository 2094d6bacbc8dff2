// The surfaces of segments that Session keeps for 3D views.
#include <algorithm>

#include "ui/workspace/segments.h"
#include "ui/workspace/session.h"

namespace volumen {

std::vector<SegmentInScene> Session::segmentsDrawn(ViewId view) const {
  std::vector<SegmentInScene> drawn;
  const LoadedSeriesPtr series = seriesOf(view);
  const SegmentMap* map = segmentMapOf(workspace_, workspace_.view(view).series);
  if (!series || !map || !isOn(*map, series->volume->geometry())) return drawn;
  for (const Segment* segment : segmentsIn3d(*map)) {
    const auto made = std::ranges::find_if(surfaces_, [&](const MadeSurface& s) {
      return s.series == map->series && s.number == segment->number;
    });
    if (made == surfaces_.end() || !made->field || made->field->geometry != series->volume->geometry())
      continue;
    drawn.push_back({segment, made->field});
  }
  return drawn;
}

Scene Session::drawnScene(ViewId view) const {
  Scene scene = sceneOf(view);
  for (const SegmentInScene& drawn : segmentsDrawn(view))
    scene.segments.push_back(surfaceOf(*drawn.segment, drawn.field));
  return scene;
}

void Session::takeSurfaces(std::vector<MadeSurface> made) {
  for (MadeSurface& surface : made) {
    std::erase_if(surfaces_, [&](const MadeSurface& before) {
      return before.series == surface.series && before.number == surface.number;
    });
    surfaces_.push_back(std::move(surface));
  }
  setWorkspace(workspace_);
}

void Session::dropSurfaces() {
  std::erase_if(surfaces_, [&](const MadeSurface& s) { return !isOfSegmentOnScreen(s, workspace_); });
}

}  // namespace volumen
