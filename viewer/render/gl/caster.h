#pragma once

#include <map>
#include <string>

#include "viewer/render/gl/ray_band.h"
#include "viewer/render/gl/volume_textures.h"
#include "viewer/render/kernels/trace.h"

namespace volumen {

/// Draws rays whole in one fragment shader: resampled, classified after interpolation, shaded and composited
/// front to back (figure 1c of the paper); or composited from preshaded voxels (figure 1b). In floats; with
/// 16 bits the hardware filters (see PlaneResampler). Needs a current context.
class Caster {
 public:
  /// Programs, tables and uniforms for a frame.
  Status prepare(const Plan& plan, const TraceFrame& frame, const VolumeTextures& textures);
  /// Draws a band. Four floats a pixel, premultiplied colour and alpha, or the density of a projection;
  /// row by row, until the next call. Empty where OpenGL failed.
  const std::vector<float>& draw(const RayBand& band, float inverseUnitMm);

 private:
  Status chooseProgram(const Plan& plan);
  Status uploadTables(const Plan& plan, const TraceFrame& frame);
  void setUniforms(const Plan& plan, const TraceFrame& frame, const VolumeTextures& textures);
  bool makeTarget(int width, int height);
  int uniform(const char* name) const;

  std::map<std::string, unsigned> programs_;  ///< by their defines
  unsigned program_ = 0, vertices_ = 0, framebuffer_ = 0, target_ = 0;
  int width_ = 0, height_ = 0;  ///< of the target
  BufferTexture rays_, curve_, buckets_, factors_, lights_, shades_;
  std::vector<float> pixels_;
};

}  // namespace volumen
