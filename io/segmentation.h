#pragma once

#include <array>
#include <string>
#include <string_view>

#include "viewer/segment/segmentation.h"

namespace volumen {

/// The terms of SegmentAlgorithmType (0062,0008), by SegmentAlgorithm; none where nothing is said.
inline constexpr std::array<std::string_view, 4> segmentAlgorithmTerms{"", "MANUAL", "SEMIAUTOMATIC",
                                                                       "AUTOMATIC"};

/// Reads a segmentation object, BINARY, FRACTIONAL or LABELMAP. Frames that repeat a place of their segment
/// are united, what is of no segment that the file describes is left out, and frames that begin on whole
/// bytes are read so: each is noted. An Error names the file and why: damaged, frames of one bit that are
/// compressed, frames of several sizes of pixels or directions, or pixel data of another length than its
/// Rows, Columns and NumberOfFrames; `pictures`, columns and rows of the pictures that it names, is told
/// there where it differs (0: not known).
Result<Segmentation> loadSegmentation(const std::string& path, glm::ivec2 pictures = glm::ivec2(0));

}  // namespace volumen
