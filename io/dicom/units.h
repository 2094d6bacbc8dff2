#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// What a Rescale Type or a Modality LUT Type (PS3.3 C.11.1.1.2) stands for: "HU", "mg/ml", "mm2/s"; terms of
/// no standard as they are, nothing where it is unspecified.
std::string unitOfRescaleType(const std::string& type);

/// The unit of a real world value mapping (PS3.3 C.7.6.16.2.11): its UCUM code as it is, or what is usually
/// said for it ("HU", "SUV"); of other codes their meaning. Empty for numbers without one.
std::string unitOfMapping(const DataSet& data, DataSet::Scope mapping);

/// The unit of a frame's values after the rescale that the file gives; empty where it does not say. `header`:
/// whose modality is known; is told what is unusual.
std::string unitOfRescaled(const DataSet& data, const FrameScopes& at, FileHeader& header);

}  // namespace volumen::dicom
