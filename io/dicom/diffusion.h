#pragma once

#include <string>
#include <vector>

#include "io/dicom/frame_scopes.h"

namespace volumen::dicom {

/// Returns the b-value in s/mm^2: DICOM's, or the private one of Siemens, Philips or GE. GE's offset of 10^9
/// is left out, and its nominal value is scaled by the squared length of the direction.
std::string readBValue(const DataSet& data, const FrameScopes& at);

/// Returns the diffusion gradient direction as stored, for comparison only.
std::string readGradientDirection(const DataSet& data, const FrameScopes& at);

/// Returns the diffusion gradient direction in the patient (LPS) from private attributes of Siemens, Philips
/// or GE; empty if there are none.
std::vector<double> privateDirection(const DataSet& data);

}  // namespace volumen::dicom
