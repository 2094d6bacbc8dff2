#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// Returns the unit of a Rescale Type or Modality LUT Type (PS3.3 C.11.1.1.2): "HU", "mg/ml", "mm2/s". Terms
/// outside the standard are returned unchanged, unspecified ones as an empty text.
std::string unitOfRescaleType(const std::string& type);

/// Reads the unit of a frame's values and the first linear Real World Value Mapping (PS3.3 C.7.6.16.2.11)
/// that is valid for all stored values. The mapping replaces a missing rescale. For PET it also reads the
/// mapping to an SUV. `header` must have its modality and receives warnings.
void readMeaning(const DataSet& data, const FrameScopes& at, Slice& slice, FileHeader& header);

}  // namespace volumen::dicom
