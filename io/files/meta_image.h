#pragma once

#include <string>

#include "io/files/image_header.h"

namespace volumen {

/// The volumes of a MetaImage (.mha, or .mhd with data files), as MetaIO documents it and ITK places it:
/// Offset and the rows of TransformMatrix are LPS. Refused with a reason: colour pictures, several channels,
/// other MetaIO objects.
Result<ImageHeader> readMetaImageHeader(const std::string& path);

}  // namespace volumen
