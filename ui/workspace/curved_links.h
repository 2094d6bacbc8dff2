#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Moves the crosshairs of curved reformats on screen and of their source to one position: the others follow
/// the one that was moved. Does nothing unless positions are linked.
Workspace withCurvesFollowed(const Workspace& before, Workspace after);

}  // namespace volumen
