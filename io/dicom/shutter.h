#pragma once

#include "io/dicom/frame_scopes.h"
#include "viewer/slice/shutter.h"

namespace volumen::dicom {

/// Returns the display shutter of a frame or a presentation state (PS3.3 C.7.6.11). `warnings` names shapes
/// that are left out.
Shutter readShutter(const DataSet& data, const FrameScopes& at, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
