#pragma once

#include "viewer/kernels/trace.h"

namespace volumen {

/// Interpolates and composites preshaded voxels along the rays of a row, front to back (picture.md 9).
/// `rgba`: four floats per voxel, colour times opacity and the opacity per unit distance, i fastest.
using PreshadedKernel = void (*)(const float* rgba, const RayInputs&, const RayRow&, const TraceRow& out,
                                 TraceCounts&);
PreshadedKernel choosePreshadedKernel();

}  // namespace volumen
