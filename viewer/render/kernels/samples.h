#pragma once

#include "viewer/render/kernels/trace.h"

namespace volumen {

/// Samples that are shaded together, one array entry each, padded to whole vectors (RaySetup::padding).
struct SampleRow {
  int count = 0;  ///< padding included
  const float* density = nullptr;
  const float* gradients = nullptr;  ///< x, y, z, 0 in stored units; null where the frame has none
  const float* units = nullptr;      ///< lengths of the samples' intervals in unit distances; 0: no sample
  /// Towards the viewer, patient space; looked at with a local viewer only.
  const float *viewerX = nullptr, *viewerY = nullptr, *viewerZ = nullptr;
};

/// Resamples the n-th sample (SCENE 9) of every ray of a row: densities, and where `gradients` is not null
/// the gradients (x, y, z, 0) of samples that the curve gives opacity, or that lie in one vector with such.
/// Rays that have no such sample keep what the arrays held.
using ResampleKernel = void (*)(const TraceFrame&, const RayRow&, int n, float* density, float* gradients);
ResampleKernel chooseResampleKernel(Store store);

/// Classifies and shades samples (SCENE 4, 5): `out` is their colour times opacity, and the opacity of their
/// intervals. Returns how many have opacity.
using ShadeKernel = std::int64_t (*)(const TraceFrame&, const SampleRow&, const TraceRow& out);
ShadeKernel chooseShadeKernel(TraceKey key);

/// slice + (1 - its alpha) * frame, of `count` premultiplied pixels (padded). `levels` 0: in floats; else the
/// largest value of a component of the frame buffer, to whose values it is rounded; nothing is above 1 then.
using BlendKernel = void (*)(const TraceRow& slice, const TraceRow& frame, int count, float levels);
BlendKernel chooseBlendKernel(bool rounded);

}  // namespace volumen
