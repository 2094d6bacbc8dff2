#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>

#include "viewer/render/gl/ray_band.h"
#include "viewer/render/gl/timer.h"
#include "viewer/render/gl/volume_textures.h"

namespace volumen {

/// Resamples slices of a band of rays, brings them back for shading, and blends shaded ones into a frame
/// buffer (paper 3.2). Two slots, so that one slice is drawn and on its way back while the CPU shades
/// another. Needs a current context.
class SliceBlender {
 public:
  /// Program and uniforms for a frame.
  Status prepare(const Plan& plan, glm::ivec3 size, const VolumeTextures& textures);
  /// Targets for a band, the frame buffer empty. An Error where OpenGL has no room.
  Status begin(const RayBand& band, float inverseUnitMm);

  /// Starts to draw the n-th samples of the band's rays and to bring them back.
  void drawSlice(int n, int slot);
  /// The samples last drawn into the slot, `stride` a row, until unmap(); gradients four floats each, null
  /// where the plan has none. Null where OpenGL failed.
  struct Samples {
    const float *density = nullptr, *gradients = nullptr;
  };
  Samples map(int slot);
  void unmap(int slot);
  /// What OpenGL took to resample slices since this was last asked, ms.
  double takeGlMs() { return std::exchange(glMs_, 0.0); }

  /// Blends a shaded slice, four floats a pixel, over (composite) or into (projections) the frame buffer.
  void blend(const float* rgba);
  /// The frame buffer, four floats a pixel. Empty where OpenGL failed.
  const std::vector<float>& pixels();

 private:
  struct Slot {
    unsigned framebuffer = 0, density = 0, gradients = 0, buffer = 0;
  };
  unsigned makeTexture(unsigned format) const;
  Status makeSlot(Slot& slot);
  Status makeFrame();
  void freeTargets();
  void useBlending() const;
  std::size_t pixelCount() const { return std::size_t(width_) * height_; }

  std::map<std::string, unsigned> programs_;  ///< of slices, by their defines
  unsigned sliceProgram_ = 0, blendProgram_ = 0, vertices_ = 0;
  unsigned density_ = 0, gradients_ = 0;  ///< textures of the volume; gradients_ 0: none
  BufferTexture rays_;
  std::array<Slot, 2> slots_;
  unsigned frame_ = 0, frameTexture_ = 0, shaded_ = 0;  ///< frame buffer; the slice that is blended
  int width_ = 0, height_ = 0;
  Mode mode_ = Mode::composite;
  Blending blending_ = Blending::floats;
  std::vector<float> pixels_;
  GlTimer timer_;
  double glMs_ = 0;
};

}  // namespace volumen
