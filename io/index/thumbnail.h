#pragma once

#include "io/index/index.h"

namespace volumen {

/// The longest side of a thumbnail, pixels.
inline constexpr int thumbnailEdge = 128;

/// The middle frame of what a file holds, by its window, in the shape of its pixels; of a volume of another
/// format its middle slice. An Error where it holds no picture or cannot be read.
Result<Thumbnail> makeThumbnail(const std::string& file, const CancelToken& cancel = {});

}  // namespace volumen
