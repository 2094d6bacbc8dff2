#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// The flat view that the menus work on: the one in focus, else the first of its group; a view to compare
/// that shows 3D has none and is returned itself.
ViewId flatViewInFocus(const Workspace& workspace);

/// "Hot iron": what a colour map is called.
QString colourMapText(ColourMap map);

/// Colours of the series that the flat view in focus shows.
QMenu* makeColourMenu(Session& session, QWidget* parent);

/// The second series of the flat views in focus, its colours and its opacity. `series` lists what is open.
QMenu* makeOverlayMenu(Session& session, std::function<std::vector<const Series*>()> series, QWidget* parent);

}  // namespace volumen
