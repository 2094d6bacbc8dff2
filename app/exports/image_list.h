#pragma once

#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Reads a list of images, "UID[/FRAME],..." with frames from 1. Returns each image once, its frames
/// ascending from 0; one that is named without frame stands for all frames. An empty text has no images. The
/// Error names the word.
Result<std::vector<ReferencedPicture>> imagesIn(const std::string& list);

}  // namespace volumen
