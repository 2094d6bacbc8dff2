#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// Whether a picture of nuclear medicine holds reconstructed slices (RECON TOMO, RECON GATED TOMO); all
/// others are projections.
bool isReconstructedNuclear(const DataSet& data);

/// Places the slices of such a picture, one a frame, all alike so far (PS3.3 C.8.4.15): SpacingBetweenSlices
/// apart along the normal, against it where that is negative, from where the detector's first slice lies.
/// What tells frames of one place apart is taken over, too. Where place, directions or distances are missing
/// slices have their number in the stack alone.
void placeNuclearFrames(const DataSet& data, FileHeader& header);

}  // namespace volumen::dicom
