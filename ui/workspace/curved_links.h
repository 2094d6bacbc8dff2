#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// With the crosshair of a series that is laid out along curves, and those of what is made of it, at one
/// place: the one that was moved is followed by the others, where positions are linked. Of what is on screen.
Workspace withCurvesFollowed(const Workspace& before, Workspace after);

}  // namespace volumen
