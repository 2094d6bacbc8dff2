#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Creates `folder` and its parents, for their owner alone, if they are missing, and makes them last
/// (makeNamesLast()). The Error: it cannot be created or written.
Status makePrivateFolder(const std::string& folder);

/// Writes the names in a folder to disk, so that its new files are still there after a power failure.
Status makeNamesLast(const std::string& folder);

}  // namespace volumen
