#pragma once

#include <string>

#include "viewer/segment/segmentation.h"

namespace volumen {

/// Reads a segmentation object, BINARY or FRACTIONAL. Frames that repeat a place of their segment are united
/// and noted. An Error names the file and why: damaged, frames of one bit that are compressed, frames of
/// several sizes of pixels or directions, or pixel data of another length than its Rows, Columns and
/// NumberOfFrames; `pictures`, columns and rows of the pictures that it names, is told there where it differs
/// (0: not known).
Result<Segmentation> loadSegmentation(const std::string& path, glm::ivec2 pictures = glm::ivec2(0));

}  // namespace volumen
