#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Which picture of its series, from 0, a view is about: the frame that it shows, or the slice as acquired
/// that it shows or that its crosshair is nearest to. None: it shows no series.
std::optional<int> pictureOf(const Workspace& workspace, ViewId view);

}  // namespace volumen
