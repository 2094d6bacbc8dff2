#pragma once

#include "viewer/plan/facts.h"

namespace volumen {

/// Returns the window of a projection whose scene has none: the file's, else P0.1 .. P99.9 (picture.md 8).
Window defaultWindow(const VolumeFacts& facts);

}  // namespace volumen
