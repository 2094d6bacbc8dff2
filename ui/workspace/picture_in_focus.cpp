#include "ui/workspace/picture_in_focus.h"

#include <algorithm>
#include <cmath>

#include "results/series/series_facts.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/key_images.h"

namespace volumen {

std::optional<int> pictureOf(const Workspace& workspace, ViewId view) {
  const Series* series = seriesIn(workspace, view);
  if (!series) return {};
  const ViewState& state = workspace.view(view);
  const FlatLook look = flatLookOf(state);
  const int last = std::max(0, int(series->files.size()) - 1);
  if (showsFrames(state.kind)) return std::clamp(look.frame, 0, last);
  const Crosshair crosshair = crosshairOf(workspace, view, *series);
  const VoxelGeometry& drawn = drawnGeometry(*series);
  if (showsSlices(state.kind)) {
    const SlicePlane plane = flatPlane(state, look, drawn, crosshair, {1, 1});
    if (const auto seen = pictureSeen(*series, drawn, plane).index) return std::clamp(*seen, 0, last);
  }
  const double k = series->acquired.voxelFromPatient(crosshair.at).z;
  return int(std::clamp(std::round(k), 0.0, double(last)));
}

}  // namespace volumen
