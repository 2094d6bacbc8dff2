#include "ui/features/go_to_picture.h"

#include "io/study/frame_series.h"
#include "results/series/series_facts.h"
#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/key_images.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

// Returns a flat view on screen that shows slices of a series, or nothing.
std::optional<ViewId> slicesViewOf(const Workspace& workspace, const SeriesKey& series) {
  for (const ViewId id : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(id);
    if (showsSlices(view.kind) && view.series == series) return id;
  }
  return {};
}

}  // namespace

Workspace withPresentation(Workspace workspace, ViewId view, const DerivedKey& presentation) {
  ViewState& state = workspace.editView(view);
  FlatLook& look = state.flats.editOrAdd(state.series);
  if (look.presentation == presentation) return workspace;
  look.presentation = presentation;
  look.inverted = false;
  makeWhole(look);
  setWindow(workspace, view, ChosenWindow());
  return workspace;
}

void showPicture(Workbench& bench, const Series& shown, int index) {
  Session& session = bench.document.session;
  const Series series = shown;
  session.endGesture();
  const QString text = tr("Go to picture");
  const auto view = slicesViewOf(session.workspace(), keyOf(series));
  if (const std::optional<int> slice = drawnSlice(series, index); view && slice) {
    session.setFocus(*view);
    const LoadedSeriesPtr held = session.seriesOf(*view);
    if (held) {
      const VoxelGeometry& geometry = drawnGeometry(series);
      glm::dvec3 pVoxel = geometry.voxelFromPatient(crosshairOf(session.workspace(), *view, *held).at);
      pVoxel.z = *slice;
      moveCrosshair(session, *view, *held, text, geometry.patientFromVoxel(pVoxel));
      return session.endGesture();
    }
  }
  showAsFrame(bench, text, series, index, {});
}

void showAsFrame(Workbench& bench, const QString& text, const Series& series, int index,
                 const DerivedKey& presentation) {
  Session& session = bench.document.session;
  session.request([](Requests& r) { r.show.reset(); });
  const ViewId view = framesViewOf(session.workspace().focus);
  if (session.workspace().series.empty()) session.showFrames(series, view);
  Workspace after = withFrames(session.workspace(), view, series);
  after.editView(view).flats.editOrAdd(keyOf(series)).frame = index;
  if (!presentation.empty()) after = withPresentation(std::move(after), view, presentation);
  session.change(text, std::move(after));
  session.endGesture();
}

}  // namespace volumen
