#include "ui/workspace/session_check.h"

#include <algorithm>
#include <set>

namespace volumen {

namespace {

void checkSegments(JsonFields& json, const Workspace& workspace) {
  for (std::size_t n = 0; n < workspace.segmentMaps.size(); ++n) {
    const SegmentMap& map = workspace.segmentMaps[n];
    const std::string path = json.pathOf("segmentMaps", n);
    if (!workspace.series.contains(map.series))
      json.refuse(path + ".series", "must be the number of a series");
    for (const SegmentMap* other : segmentMapsOf(workspace, map.series)) {
      if (other != &map && other->number == map.number) json.refuse(path + ".number", "is there twice");
      if (other->in3d != map.in3d || other->tissue != map.tissue)
        json.refuse(path, "must have in3d and tissueIn3d of the other maps of its series");
    }
    std::set<int> numbers;
    for (const Segment& segment : map.segments)
      if (!numbers.insert(segment.number).second)
        json.refuse(path + ".segments", "must have numbers of which none is there twice");
    if (map.current != 0 && !numbers.contains(map.current))
      json.refuse(path + ".current", "must be 0 or the number of a segment");
  }
}

}  // namespace

void checkViews(JsonFields& json, const Workspace& workspace) {
  for (ViewId id = 0; id < firstComparedId; ++id) {
    const bool isVolume = showsScene(usualKind(id));
    if (showsScene(workspace.view(id).kind) != isVolume)
      json.refuse(json.pathOf("views", std::size_t(id)) + ".kind",
                  isVolume ? "must be \"volume\"" : "must not be \"volume\"");
  }
  for (const ViewId id : {coronalViewId, sagittalViewId})
    if (showsFrames(workspace.view(id).kind))
      json.refuse(json.pathOf("views", std::size_t(id)) + ".kind", "must not be \"frames\"");
  std::set<int> ids;
  for (std::size_t n = 0; n < workspace.measurements.size(); ++n) {
    const Measurement& m = workspace.measurements[n];
    if (!workspace.series.contains(m.series))
      json.refuse(json.pathOf("measurements", n) + ".series", "must be the number of a series");
    if (!ids.insert(m.id).second) json.refuse(json.pathOf("measurements", n) + ".id", "is there twice");
  }
  for (std::size_t n = 0; n < workspace.keyImages.size(); ++n)
    if (!workspace.series.contains(workspace.keyImages[n].series))
      json.refuse(json.pathOf("keyImages", n) + ".series", "must be the number of a series");
  checkSegments(json, workspace);
  const auto isIn = [](const std::vector<ViewId>& views, ViewId id) {
    return std::ranges::find(views, id) != views.end();
  };
  if (!isIn(viewsOnScreen(workspace), workspace.focus))
    json.refuse("focus", "must be a view of the layout");
  else if (!isIn(viewsInMain(workspace), mainFocusOf(workspace)))
    json.refuse("second.mainFocus", "must be a view of the layout");
}

}  // namespace volumen
