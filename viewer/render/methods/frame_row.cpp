#include "viewer/render/methods/frame_row.h"

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

FrameRow::FrameRow(Blending blending, std::size_t count)
    : levels_(levelsOf(blending)), blend_(chooseBlendKernel(levels_ > 0)), values_(4 * count, 0.0f) {}

void FrameRow::blend(const TraceRow& slice) {
  blend_(slice, pixels(), int(values_.size() / 4), float(levels_));
}

}  // namespace volumen
