#pragma once

#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Makes the phantom `text` = NAME[:SIZE] (design.md 10): ct-head, sphere, opaque-sphere, solid, soft-sphere,
/// ramp, cube, marschner-lobb. Refused with a sentence that lists the names: an unknown name, a size
/// outside 2..1024.
Result<VolumePtr> makePhantom(const std::string& text);

/// The phantom `text` from values that were kept: quick where makePhantom takes seconds. Refused as by
/// makePhantom, and where this version of the program would give other values (ct-head alone is looked at).
Result<VolumePtr> phantomFrom(const std::string& text, std::vector<std::int16_t> values);

/// What a phantom will be, without its values: quick where makePhantom takes seconds.
struct PhantomHeader {
  VoxelGeometry geometry;
  std::string valueType;  ///< "uint8", "int16", "float32"
  std::string modality;   ///< "CT" or empty
};

/// The header of the phantom `text`. Refused as by makePhantom.
Result<PhantomHeader> phantomHeader(const std::string& text);

/// Names of all phantoms, for help texts.
std::vector<std::string> phantomNames();

}  // namespace volumen
