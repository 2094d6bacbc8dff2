#pragma once

#include "io/dicom/frame_scopes.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// What the display shutters of a frame hide (PS3.3 C.7.6.11): one byte a pixel, 1 outside any of its
/// rectangle, circle and polygon; empty where they hide nothing. `warnings`: shapes that are left out.
std::vector<std::uint8_t> readShutter(const DataSet& data, const FrameScopes& at, glm::ivec2 size,
                                      glm::dvec2 pixelMm, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
