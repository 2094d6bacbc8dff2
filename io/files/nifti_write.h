#pragma once

#include <string>

#include "io/files/sample_type.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The fourth axis.
struct NiftiTime {
  int volumes = 1;
  double stepSeconds = 0;  ///< from one to the next; 0: not known
};

/// The 352 bytes before the samples of a single NIfTI-1 file, little endian: the sform always, the qform
/// where the axes are at right angles but for rounding (1e-4; it knows no shear), neither where the geometry
/// is not calibrated. Refused: more than 32767 voxels along an axis.
Result<std::string> niftiHeader(const VoxelGeometry& geometry, SampleType type, double slope,
                                double intercept, const NiftiTime& time = {});

}  // namespace volumen
