#pragma once

#include <QString>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns "3 rows, 2 columns" for a grid.
QString gridText(const Layout& grid);

/// Returns the invitation of an empty comparison view: "T2, axial: drop a series here ...".
QString invitationText(const ViewState& view);

}  // namespace volumen
