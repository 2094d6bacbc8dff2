#pragma once

#include <cstdint>
#include <vector>

#include "io/dicom/scan.h"
#include "io/regular_file.h"

namespace volumen::dicom {

/// A range of bytes of a file.
struct Range {
  std::uint64_t offset = 0, length = 0;
};
using FrameRanges = std::vector<Range>;  ///< the parts of one frame, in order

/// Locates the frames of encapsulated pixel data (PS3.5 A.4): for each frame a list of fragments. If there
/// are as many fragments as frames, each is a frame. Else the basic offset table separates frames, else the
/// start markers of code streams. Returns an Error for fragments that are cut off, fewer fragments than
/// frames, or frames that cannot be separated.
Result<std::vector<FrameRanges>> encapsulatedFrames(const RegularFile& file, const Element& pixels,
                                                    int frames);

/// Returns where encapsulated pixel data end: after their delimiter. The Error: they are cut off or damaged.
Result<std::uint64_t> endOfFragments(const RegularFile& file, const Element& pixels);

}  // namespace volumen::dicom
