#pragma once

#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Makes the phantom `text` = NAME[:SIZE] (design.md 10): ct-head, sphere, opaque-sphere, solid, soft-sphere,
/// ramp, cube, marschner-lobb. Returns an Error that lists the names for an unknown name, and one that states
/// the limits for a size outside 2..1024.
Result<VolumePtr> makePhantom(const std::string& text);

/// Makes the phantom `text` from stored values: quick where makePhantom takes seconds. Returns the Errors of
/// makePhantom, and one if this program version would compute other values. Supports ct-head only.
Result<VolumePtr> phantomFrom(const std::string& text, std::vector<std::int16_t> values);

/// Describes a phantom without its values: quick where makePhantom takes seconds.
struct PhantomHeader {
  VoxelGeometry geometry;
  std::string valueType;  ///< One of "uint8", "int16", "float32".
  std::string modality;   ///< Either "CT" or empty.
};

/// Returns the header of the phantom `text`, or the Errors of makePhantom.
Result<PhantomHeader> phantomHeader(const std::string& text);

/// Returns the names of all phantoms, for help texts.
std::vector<std::string> phantomNames();

}  // namespace volumen
