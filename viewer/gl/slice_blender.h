#pragma once

#include <array>
#include <utility>

#include "viewer/gl/program.h"
#include "viewer/gl/ray_band.h"
#include "viewer/gl/target.h"
#include "viewer/gl/timer.h"
#include "viewer/gl/volume_textures.h"

namespace volumen {

/// Resamples slices of a band of rays, reads them back for shading, and blends shaded slices into a frame
/// buffer (paper 3.2). Two slots let one slice be drawn and read back while the CPU shades another. Needs a
/// current context.
class SliceBlender {
 public:
  /// Sets up program and uniforms for a picture.
  Status prepare(const Plan& plan, const VolumeTextures& textures);
  /// Makes the targets for a band and clears the frame buffer. Returns an Error if OpenGL runs out of memory.
  Status begin(const RayBand& band, float inverseUnitMm);

  /// Starts to draw the n-th samples of the band's rays and to read them back.
  void drawSlice(int n, int slot);
  /// Returns the samples last drawn into the slot, `stride` per row, valid until unmap(); null if OpenGL
  /// failed.
  SampleTarget::Samples map(int slot);
  void unmap(int slot) { slots_[slot].unmap(); }
  /// Returns the time, in ms, that OpenGL has spent on resampling slices since the last call.
  double takeGlMs() { return std::exchange(glMs_, 0.0); }

  /// Blends a shaded slice, four floats per pixel, over (composite) or into (projections) the frame buffer.
  void blend(const float* rgba);
  /// Returns the frame buffer, four floats per pixel; empty if OpenGL failed.
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
  unsigned shaded_ = 0;  ///< Texture of the slice to blend.
  glm::ivec2 size_{0};
  bool gradients_ = false;
  Mode mode_ = Mode::composite;
  Blending blending_ = Blending::floats;
  GlTimer timer_;
  double glMs_ = 0;
};

}  // namespace volumen
