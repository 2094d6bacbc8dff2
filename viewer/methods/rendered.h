#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// Cost of a picture. Times are wall-clock ms; resample and shade are summed over threads and divided by
/// their number. With OpenGL, which resamples while the CPU shades: resample is the time in which the CPU
/// waited or worked for OpenGL, shade is the rest.
struct RenderStats {
  double gradientsMs = 0;  ///< Sobel pass and copies made for this picture; 0 if they existed already.
  double resampleMs = 0, shadeMs = 0, totalMs = 0;
  double surfacesMs = 0;  ///< Finding and lighting surfaces of segments; averaged over threads likewise.
  double pilotMs = 0;     ///< Time of the pilot, for choices that the plan left open.
  double glMs = 0;        ///< Time of OpenGL itself. It overlaps with shadeMs if glMs + shadeMs > totalMs.
  std::int64_t resampled = 0, shaded = 0, composited = 0;  ///< Numbers of samples.
  std::int64_t redone = 0;  ///< Number of rays redone cell by cell (Plan::redoneAbove).
  std::size_t densityBytes = 0, gradientBytes = 0, blockBytes = 0, tableBytes = 0;
  int threads = 1;
  std::string kernel;  ///< E.g. "AVX3_ZEN4", "reference", "llvmpipe (LLVM 15.0.6, 256 bits)".
};

struct Rendered {
  Picture picture;
  /// Estimated error of each pixel (of its largest component, in 1/255). Cell by cell it is a bound: the sum
  /// over the parts of its ray. In pictures of plain steps that a pilot accepted it is a prediction, and a
  /// few pixels are off by more (PilotFinding::errorScale). Empty if nothing is known.
  std::vector<float> error;
  RenderStats stats;
  Plan plan;  ///< The plan as drawn, with nothing left open.
};

}  // namespace volumen
