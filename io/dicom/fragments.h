#pragma once

#include <cstdint>
#include <vector>

#include "io/dicom/scan.h"
#include "io/regular_file.h"

namespace volumen::dicom {

/// Bytes of a file.
struct Range {
  std::uint64_t offset = 0, length = 0;
};
using FrameRanges = std::vector<Range>;  ///< the parts of one frame, in order

/// Where the frames of encapsulated pixel data lie (PS3.5 A.4): one entry a frame, each a list of fragments.
/// Frames are told apart by the basic offset table, else one fragment each, else by the code streams' start
/// markers. Refused: fragments that are cut off, fewer fragments than frames, frames that cannot be told
/// apart.
Result<std::vector<FrameRanges>> encapsulatedFrames(const RegularFile& file, const Element& pixels,
                                                    int frames);

}  // namespace volumen::dicom
