#pragma once

#include <QString>

#include "ui/workspace/workspace.h"

namespace volumen {

/// "3 rows, 2 columns" of a grid.
QString gridText(const Layout& grid);

/// What an empty view to compare asks for: "T2, axial: drop a series here ...".
QString invitationText(const ViewState& view);

}  // namespace volumen
