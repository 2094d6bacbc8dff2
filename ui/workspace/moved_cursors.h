#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Whether cursors and shown frames have moved, and nothing else is different.
bool movesCursorsAlone(const Workspace& before, const Workspace& after);

}  // namespace volumen
