#pragma once

#include "viewer/kernels/trace.h"

namespace volumen {

/// Samples to shade together, one array entry each, padded to whole vectors (RayGenerator::padding).
struct SampleRow {
  int count = 0;  ///< Includes the padding.
  const float* density = nullptr;
  const float* gradients = nullptr;  ///< x, y, z, 0 in stored units; null if the picture has no gradients.
  const float* unitDistances = nullptr;  ///< Lengths of the intervals in unit distances; 0: no sample.
  /// Direction towards the viewer in patient space; read only with a local viewer.
  const float *viewerX = nullptr, *viewerY = nullptr, *viewerZ = nullptr;
};

/// Classifies and shades samples (picture.md 4, 5). `out` receives colour times opacity, and the opacity of
/// the intervals. Returns the number of samples with opacity.
using ShadeKernel = std::int64_t (*)(const RayInputs&, const SampleRow&, const TraceRow& out);
ShadeKernel chooseShadeKernel(KernelKey key);

}  // namespace volumen
