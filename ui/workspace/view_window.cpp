#include "ui/workspace/view_window.h"

namespace volumen {

SeriesState seriesStateIn(const Workspace& workspace, ViewId view) {
  const ViewState& shown = workspace.view(view);
  SeriesState state = workspace.series.at(shown.series);
  if (const auto alone = flatLookOf(shown).windowAlone) {
    state.window = alone->window;
    state.namedGrey = alone->namedGrey;
  }
  return state;
}

void setWindow(Workspace& workspace, ViewId view, const ChosenWindow& chosen) {
  const SeriesKey key = workspace.view(view).series;
  if (!workspace.series.contains(key)) return;
  if (flatLookOf(workspace.view(view)).windowAlone) {
    workspace.editView(view).flats.edit(key).windowAlone = chosen;
    return;
  }
  SeriesState& state = workspace.series.edit(key);
  state.window = chosen.window;
  state.namedGrey = chosen.namedGrey;
}

void setWindow(Workspace& workspace, ViewId view, const std::optional<Window>& window) {
  if (!workspace.series.contains(workspace.view(view).series)) return;
  setWindow(workspace, view, ChosenWindow{window, seriesStateIn(workspace, view).namedGrey});
}

Workspace withWindowAlone(Workspace workspace, ViewId view, bool alone) {
  const SeriesKey key = workspace.view(view).series;
  if (!workspace.series.contains(key)) return workspace;
  const SeriesState state = seriesStateIn(workspace, view);
  FlatLook& look = workspace.editView(view).flats.editOrAdd(key);
  look.windowAlone.reset();
  if (alone) look.windowAlone = ChosenWindow{state.window, state.namedGrey};
  return workspace;
}

}  // namespace volumen
