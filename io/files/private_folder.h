#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Creates `folder` and its parents, for their owner alone, if they are missing. The Error: it cannot be
/// created or written.
Status makePrivateFolder(const std::string& folder);

}  // namespace volumen
