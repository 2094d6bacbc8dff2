#pragma once

#include <string>

#include "viewer/segment/segmentation.h"

namespace volumen {

/// Reads a segmentation object, BINARY or FRACTIONAL. An Error names the file and why: damaged, frames of one
/// bit that are compressed, or frames of several sizes of pixels or directions.
Result<Segmentation> loadSegmentation(const std::string& path);

}  // namespace volumen
