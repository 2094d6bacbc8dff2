#pragma once

#include <string>

#include "viewer/volume/volume.h"

namespace volumen {

/// The user's folder for what can be made again, of this program alone; it need not exist.
std::string userCacheFolder();

/// makePhantom(text) of a ct-head, which takes seconds: from a file in `folder`, where that holds intact
/// values of this version of the program; else it is made and kept there. Where it cannot be kept, it only
/// takes its time again.
Result<VolumePtr> cachedPhantom(const std::string& text, const std::string& folder);

}  // namespace volumen
