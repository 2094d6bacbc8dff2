#pragma once

#include "viewer/kernels/trace.h"

namespace volumen {

/// Samples that are shaded together, one array entry each, padded to whole vectors (RayGenerator::padding).
struct SampleRow {
  int count = 0;  ///< padding included
  const float* density = nullptr;
  const float* gradients = nullptr;  ///< x, y, z, 0 in stored units; null where the picture has none
  const float* unitDistances =
      nullptr;  ///< lengths of the samples' intervals in unit distances; 0: no sample
  /// Towards the viewer, patient space; looked at with a local viewer only.
  const float *viewerX = nullptr, *viewerY = nullptr, *viewerZ = nullptr;
};

/// Classifies and shades samples (picture.md 4, 5): `out` is their colour times opacity, and the opacity of
/// their intervals. Returns how many have opacity.
using ShadeKernel = std::int64_t (*)(const RayInputs&, const SampleRow&, const TraceRow& out);
ShadeKernel chooseShadeKernel(KernelKey key);

}  // namespace volumen
