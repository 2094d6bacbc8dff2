#pragma once

#include <optional>

#include "ui/workspace/workspace.h"

namespace volumen {

// A flat view has the window of its series, as all views of that do, or one alone (FlatLook::windowAlone).

/// What holds for the series of a view there: its state, with the window of the view where that has one
/// alone. The view shows a series.
SeriesState seriesStateIn(const Workspace& workspace, ViewId view);

/// Gives what a flat view shows a window: the view where it has one alone, else its series. Where it shows
/// nothing, nothing is changed.
void setWindow(Workspace& workspace, ViewId view, const ChosenWindow& chosen);
/// The same; of the file's own windows the one that was chosen stays.
void setWindow(Workspace& workspace, ViewId view, const std::optional<Window>& window);

/// With the window of a flat view alone, at first as it is; or no longer: it shows that of its series.
Workspace withWindowAlone(Workspace workspace, ViewId view, bool alone);

}  // namespace volumen
