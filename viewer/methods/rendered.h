#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// What a picture took. Times in ms of wall clock; resample and shade are summed over threads and divided by
/// their number. With OpenGL, which resamples while the CPU shades: resample is what the CPU had to wait or
/// work for OpenGL, shade the rest.
struct RenderStats {
  double gradientsMs = 0;  ///< Sobel pass and copies made for this picture; 0 where they were there already
  double resampleMs = 0, shadeMs = 0, totalMs = 0;
  double surfacesMs = 0;  ///< finding and lighting surfaces of segments, likewise
  double pilotMs = 0;     ///< finding what the plan left open
  double glMs = 0;  ///< what OpenGL itself took; it overlaps with shadeMs where glMs + shadeMs > totalMs
  std::int64_t resampled = 0, shaded = 0, composited = 0;  ///< samples
  std::size_t densityBytes = 0, gradientBytes = 0, blockBytes = 0, tableBytes = 0;
  int threads = 1;
  std::string kernel;  ///< e.g. "AVX3_ZEN4", "reference", "llvmpipe (LLVM 15.0.6, 256 bits)"
};

struct Rendered {
  Picture picture;
  /// How far each pixel may be off (its largest component; 1/255), one entry a pixel: the sum of what its
  /// ray's parts may be off by. Empty where the path that drew it knows none.
  std::vector<float> error;
  RenderStats stats;
  Plan plan;  ///< as drawn: nothing is left open
};

}  // namespace volumen
