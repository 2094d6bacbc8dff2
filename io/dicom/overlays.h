#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/decode.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Returns the overlay planes 60xx of frame `n` (PS3.3 C.9.2), clipped to the picture, from Overlay Data or
/// unused bits of the pixels. `warnings` names planes that are left out and the reason.
std::vector<FrameOverlay> readOverlays(const DataSet& data, const PixelSource& pixels,
                                       const FileHeader& header, int n, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
