#include "viewer/render/methods/frame_row.h"

#include <algorithm>

namespace volumen {

int levelsOf(Blending blending) {
  return blending == Blending::floats ? 0 : blending == Blending::bits16 ? 65535 : 255;
}

void roundPixels(Blending blending, const RayRow& rays, Picture& picture) {
  const int levels = levelsOf(blending);
  if (levels == 0) return;
  for (int pixel : rays.pixel)
    for (int c = 0; pixel >= 0 && c < 4; ++c) {
      float& x = picture.rgba[std::size_t(4) * pixel + c];
      x = rounded(x, float(levels));
    }
}

namespace {

void blendFloats(const float* source, const float* alpha, float* target, std::size_t count) {
  for (std::size_t n = 0; n < count; ++n) target[n] = source[n] + (1 - alpha[n]) * target[n];
}

void blendRounded(const float* source, const float* alpha, float* target, std::size_t count, float levels) {
  for (std::size_t n = 0; n < count; ++n) {
    const float sum = std::min(source[n], 1.0f) + (1 - alpha[n]) * target[n];
    target[n] = rounded(std::min(sum, 1.0f), levels);
  }
}

}  // namespace

void FrameRow::blend(const TraceRow& slice) {
  const std::size_t count = values_.size() / 4;
  const float levels = float(levelsOf(blending_));
  const float* sources[] = {slice.red, slice.green, slice.blue, slice.alpha};
  for (int c = 0; c < 4; ++c) {
    float* target = values_.data() + c * count;
    if (blending_ == Blending::floats)
      blendFloats(sources[c], slice.alpha, target, count);
    else
      blendRounded(sources[c], slice.alpha, target, count, levels);
  }
}

}  // namespace volumen
