#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// Makes the menu that links views and frames of reference. Its tooltip says why views are not linked.
/// `registerThem` registers the series on screen.
QMenu* makeLinkMenu(Session& session, std::function<void()> registerThem, QWidget* parent);

}  // namespace volumen
