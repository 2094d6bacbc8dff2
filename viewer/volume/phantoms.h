#pragma once

#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Makes the phantom `text` = NAME[:SIZE] (DESIGN 10): ct-head, sphere, opaque-sphere, solid, soft-sphere,
/// ramp, cube, marschner-lobb. Refused with a sentence that lists the names: an unknown name, a size
/// outside 2..1024.
Result<VolumePtr> makePhantom(const std::string& text);

/// Names of all phantoms, for help texts.
std::vector<std::string> phantomNames();

}  // namespace volumen
