#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// Returns whether a nuclear medicine picture holds reconstructed slices (RECON TOMO, RECON GATED TOMO). All
/// others are projections.
bool isReconstructedNuclear(const DataSet& data);

/// Sets the positions of the slices of such a picture, one for each frame (PS3.3 C.8.4.15). They start at the
/// detector's first slice and are SpacingBetweenSlices apart along the normal, or against it if negative. It
/// also sets the values that separate frames at one position. If position, directions or distance are
/// missing, slices only have their number in the stack.
void placeNuclearFrames(const DataSet& data, FileHeader& header);

}  // namespace volumen::dicom
