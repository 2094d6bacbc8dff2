#pragma once

#include <optional>

#include "ui/workspace/workspace.h"

namespace volumen {

// A flat view has the window of its series, as all views of that do, or its own (FlatLook::windowAlone).

/// Returns the state of the series in a view, with the view's own window if it has one. The view must show a
/// series.
SeriesState seriesStateIn(const Workspace& workspace, ViewId view);

/// Sets the window of a flat view: its own if it has one, else that of its series. Does nothing if the view
/// is empty.
void setWindow(Workspace& workspace, ViewId view, const ChosenWindow& chosen);
/// Does the same and keeps the choice among the file's own windows.
void setWindow(Workspace& workspace, ViewId view, const std::optional<Window>& window);

/// Gives a flat view its own window, at first the present one, or returns it to that of its series.
Workspace withWindowAlone(Workspace workspace, ViewId view, bool alone);

}  // namespace volumen
