#pragma once

#include <array>
#include <utility>

#include "viewer/gl/program.h"
#include "viewer/gl/ray_band.h"
#include "viewer/gl/target.h"
#include "viewer/gl/timer.h"
#include "viewer/gl/volume_textures.h"

namespace volumen {

/// Resamples slices of a band of rays, brings them back for shading, and blends shaded ones into a picture
/// buffer (paper 3.2). Two slots, so that one slice is drawn and on its way back while the CPU shades
/// another. Needs a current context.
class SliceBlender {
 public:
  /// Program and uniforms for a picture.
  Status prepare(const Plan& plan, const VolumeTextures& textures);
  /// Targets for a band, the frame buffer empty. An Error where OpenGL has no room.
  Status begin(const RayBand& band, float inverseUnitMm);

  /// Starts to draw the n-th samples of the band's rays and to bring them back.
  void drawSlice(int n, int slot);
  /// The samples last drawn into the slot, `stride` a row, until unmap(); null where OpenGL failed.
  SampleTarget::Samples map(int slot);
  void unmap(int slot) { slots_[slot].unmap(); }
  /// What OpenGL took to resample slices since this was last asked, ms.
  double takeGlMs() { return std::exchange(glMs_, 0.0); }

  /// Blends a shaded slice, four floats a pixel, over (composite) or into (projections) the frame buffer.
  void blend(const float* rgba);
  /// The frame buffer, four floats a pixel. Empty where OpenGL failed.
  const std::vector<float>& pixels() { return frame_.pixels(); }

 private:
  bool makeTargets();
  void clearFrame() const;
  void useBlending() const;

  Programs slicePrograms_, blendPrograms_;
  unsigned sliceProgram_ = 0, blendProgram_ = 0, vertices_ = 0;
  BufferTexture rays_;
  std::array<SampleTarget, 2> slots_;
  PictureTarget frame_;
  unsigned shaded_ = 0;  ///< the slice that is blended
  glm::ivec2 size_{0};
  bool gradients_ = false;
  Mode mode_ = Mode::composite;
  Blending blending_ = Blending::floats;
  GlTimer timer_;
  double glMs_ = 0;
};

}  // namespace volumen
