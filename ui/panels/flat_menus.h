#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// Returns the flat view that the menus work on: the one in focus, else the first of its group. A comparison
/// view that shows 3D has no flat view and is returned itself.
ViewId flatViewInFocus(const Workspace& workspace);

/// Returns the name of a colour map, such as "Hot iron".
QString colourMapText(ColourMap map);

/// Makes the menu for the colours of the series in the focused flat view.
QMenu* makeColourMenu(Session& session, QWidget* parent);

/// Makes the menu for the overlay of the focused flat views, its colours and opacity. `series` returns the
/// open series.
QMenu* makeOverlayMenu(Session& session, std::function<std::vector<const Series*>()> series, QWidget* parent);

}  // namespace volumen
