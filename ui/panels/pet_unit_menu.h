#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// Makes the menu for the unit of all PET values. Entries say what the series in focus lacks for a unit.
QMenu* makePetUnitMenu(Session& session, QWidget* parent);

}  // namespace volumen
