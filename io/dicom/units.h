#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// What a Rescale Type or a Modality LUT Type (PS3.3 C.11.1.1.2) stands for: "HU", "mg/ml", "mm2/s"; terms of
/// no standard as they are, nothing where it is unspecified.
std::string unitOfRescaleType(const std::string& type);

/// Reads what the values of a frame are: their unit, and the first linear Real World Value Mapping
/// (PS3.3 C.7.6.16.2.11) that is valid for all stored values, which stands in for a rescale that is not
/// there. Of PET also the mapping to an SUV. `header`, whose modality is known, is told what is unusual.
void readMeaning(const DataSet& data, const FrameScopes& at, Slice& slice, FileHeader& header);

}  // namespace volumen::dicom
