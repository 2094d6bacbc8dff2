#pragma once

#include <vector>

#include "viewer/plan/options.h"
#include "viewer/render/kernels/samples.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// One row of a frame buffer that slices are blended into, premultiplied, first empty. Of 8 or 16 bits it is
/// rounded after each slice, and holds nothing above 1.
class FrameRow {
 public:
  FrameRow(Blending blending, std::size_t count);

  /// slice + (1 - its alpha) * what was there; one entry a pixel.
  void blend(const TraceRow& slice);
  TraceRow pixels() { return rowOf(values_); }

  /// A row of red, green, blue and alpha, one behind the other.
  static TraceRow rowOf(std::vector<float>& values) {
    const std::size_t n = values.size() / 4;
    return {values.data(), values.data() + n, values.data() + 2 * n, values.data() + 3 * n};
  }

 private:
  int levels_;
  BlendKernel blend_;
  std::vector<float> values_;
};

/// The largest value of a component of 8 or 16 bits; 0 for floats.
int levelsOf(Blending blending);

/// Rounds the rays' pixels as such a frame buffer keeps them.
void roundPixels(Blending blending, const RayRow& rays, Picture& picture);

/// x in 0..1 as a frame buffer of so many levels keeps it.
inline float rounded(float x, float levels) { return float(int(x * levels + 0.5f)) / levels; }

}  // namespace volumen
