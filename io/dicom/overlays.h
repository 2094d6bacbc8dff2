#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/decode.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// The overlay planes 60xx of frame `n` (PS3.3 C.9.2), cut at the picture's border: from Overlay Data, or
/// from the unused bits of the pixels. `warnings`: those that are left out, and why.
std::vector<FrameOverlay> readOverlays(const DataSet& data, const PixelSource& pixels,
                                       const FileHeader& header, int n, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
