#pragma once

#include <string>

#include "viewer/volume/volume.h"

namespace volumen {

/// Returns this program's own cache folder of the user; it may not exist.
std::string userCacheFolder();

/// Returns makePhantom(text) of a ct-head, which takes seconds. Reads it from a file in `folder` if that
/// holds intact values of this program version; else computes it and tries to keep it there.
Result<VolumePtr> cachedPhantom(const std::string& text, const std::string& folder);

}  // namespace volumen
