#pragma once

#include <string>

#include "io/files/sample_type.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The time axis.
struct NiftiTime {
  int volumes = 1;
  double stepSeconds = 0;  ///< time step between volumes; 0: unknown
};

/// Returns the 352 bytes before the samples of a single NIfTI-1 file, little endian. It always has an sform,
/// and a qform if the axes are perpendicular within rounding (1e-4; it cannot hold shear). Without
/// calibration it has neither. The Error: more than 32767 voxels along an axis.
Result<std::string> niftiHeader(const VoxelGeometry& geometry, SampleType type, double slope,
                                double intercept, const NiftiTime& time = {});

}  // namespace volumen
