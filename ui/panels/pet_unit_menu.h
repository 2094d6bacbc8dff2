#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// What PET is shown in, everywhere; entries say what the series in focus lacks for it.
QMenu* makePetUnitMenu(Session& session, QWidget* parent);

}  // namespace volumen
