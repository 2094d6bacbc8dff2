#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns the index (from 0) of a view's picture in its series: the shown frame, or the acquired slice shown
/// or nearest to the crosshair. Empty without a series.
std::optional<int> pictureOf(const Workspace& workspace, ViewId view);

}  // namespace volumen
