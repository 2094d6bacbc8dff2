#pragma once

#include "io/dicom/frame_scopes.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// A size or shape of pixels: x along i, y along j, which stands first in the file (PS3.3 10.7.1.3). Nothing
/// where it is no pair of positive numbers.
std::optional<glm::dvec2> readSpacing(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// How large a pixel is, and what that size stands for (PS3.3 10.7): of a projection
/// calibrated, at the detector or divided by the magnification; else PixelSpacing as it is; where there is no
/// size, its shape by PixelAspectRatio.
PixelSize readPixelSize(const DataSet& data, const FrameScopes& at, const std::string& modality);

/// The regions of an ultrasound picture with units of their own (PS3.3 C.8.5.5).
std::vector<UltrasoundRegion> readRegions(const DataSet& data);

}  // namespace volumen::dicom
