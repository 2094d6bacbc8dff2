#pragma once

#include <array>
#include <string>
#include <string_view>

#include "viewer/segment/segmentation.h"

namespace volumen {

/// Terms of SegmentAlgorithmType (0062,0008) by SegmentAlgorithm; empty for unsaid.
inline constexpr std::array<std::string_view, 4> segmentAlgorithmTerms{"", "MANUAL", "SEMIAUTOMATIC",
                                                                       "AUTOMATIC"};

/// Reads a segmentation object: BINARY, FRACTIONAL or LABELMAP. Notes report three repairs: frames at the
/// same position of a segment are united, pixels of undescribed segments are left out, frames padded to whole
/// bytes are accepted.
/// The Error names the file and the reason: damaged, compressed frames of one bit, frames of several pixel
/// sizes or directions, or pixel data whose length contradicts Rows, Columns and NumberOfFrames. In the last
/// case it also states `pictures`, columns and rows of the referenced images, if they differ (0: unknown).
Result<Segmentation> loadSegmentation(const std::string& path, glm::ivec2 pictures = glm::ivec2(0));

}  // namespace volumen
