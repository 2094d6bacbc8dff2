#pragma once

#include "io/dicom/frame_scopes.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Returns a size or aspect of pixels: x along i, y along j. The file gives y first (PS3.3 10.7.1.3). Returns
/// nothing if the value is no pair of positive numbers.
std::optional<glm::dvec2> readSpacing(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// Returns the size of a pixel and its meaning (PS3.3 10.7). For projections it is calibrated, or at the
/// detector and divided by the magnification. For others it is PixelSpacing. Without a size it is the shape
/// by PixelAspectRatio.
PixelSize readPixelSize(const DataSet& data, const FrameScopes& at, const std::string& modality);

/// Returns the regions of an ultrasound picture that have their own units (PS3.3 C.8.5.5).
std::vector<UltrasoundRegion> readRegions(const DataSet& data);

}  // namespace volumen::dicom
