#pragma once

#include <string>

#include "io/files/image_header.h"

namespace volumen {

/// Reads the header of a MetaImage (.mha, or .mhd with data files) as documented by MetaIO and placed by ITK:
/// Offset and the rows of TransformMatrix are LPS. The Error gives a reason: colour images, other MetaIO
/// objects.
Result<ImageHeader> readMetaImageHeader(const std::string& path);

}  // namespace volumen
