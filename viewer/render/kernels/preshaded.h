#pragma once

#include "viewer/render/kernels/trace.h"

namespace volumen {

/// Voxels that were classified and shaded: four floats each, colour times opacity and the opacity per unit
/// distance, i fastest.
struct PreshadedVoxels {
  glm::ivec3 size{1};
  const float* rgba = nullptr;
};

/// Interpolates and composites preshaded voxels along the rays of a row, front to back (SCENE 9).
using PreshadedKernel = void (*)(const PreshadedVoxels&, const TraceFrame&, const RayRow&,
                                 const TraceRow& out, TraceCounts&);
PreshadedKernel choosePreshadedKernel();

}  // namespace volumen
