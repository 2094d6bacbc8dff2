#include "ui/workspace/moved_cursors.h"

namespace volumen {

bool movesCursorsAlone(const Workspace& before, const Workspace& after) {
  Workspace moved = before;
  moved.crosshairs = after.crosshairs;
  for (ViewId id = 0; id < viewCount; ++id) {
    const ViewState& view = after.view(id);
    if (moved.view(id) == view) continue;
    ViewState& to = moved.editView(id);
    to.crosshairs = view.crosshairs;
    for (const auto& [series, look] : view.flats)
      if (to.flats.find(series) != to.flats.end()) to.flats.edit(series).frame = look.frame;
  }
  return moved == after && before != after;
}

}  // namespace volumen
