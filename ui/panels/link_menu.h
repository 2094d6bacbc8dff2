#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// What of the views on screen follows what, and how frames of reference are linked; its tooltip says why
/// views are not linked. `registerThem` registers what the views on screen show.
QMenu* makeLinkMenu(Session& session, std::function<void()> registerThem, QWidget* parent);

}  // namespace volumen
