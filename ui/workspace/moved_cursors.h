#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns whether cursors or shown frames moved and all else is equal.
bool movesCursorsAlone(const Workspace& before, const Workspace& after);

}  // namespace volumen
