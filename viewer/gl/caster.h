#pragma once

#include "viewer/gl/program.h"
#include "viewer/gl/ray_band.h"
#include "viewer/gl/target.h"
#include "viewer/gl/volume_textures.h"
#include "viewer/kernels/trace.h"

namespace volumen {

/// Draws rays whole in one fragment shader: resampled, classified after interpolation, shaded and composited
/// front to back (figure 1c of the paper); or composited from preshaded voxels (figure 1b). In floats; with
/// 16 bits the hardware filters (see PlaneResampler). Long rays take several passes. Needs a current context.
class Caster {
 public:
  /// Programs, tables and uniforms for a picture.
  Status prepare(const Plan& plan, const RayInputs& inputs, const VolumeTextures& textures);
  /// Draws a band. An Error where OpenGL has no room.
  Status draw(const RayBand& band, float inverseUnitMm);
  /// The band, four floats a pixel, row by row, until the next call: premultiplied colour and alpha, or of a
  /// projection the extreme density and 0, or the sum of density times length and the length. Empty where
  /// OpenGL failed.
  const std::vector<float>& pixels() { return target_.pixels(); }

 private:
  Status chooseProgram(const Plan& plan);
  Status uploadTables(const Plan& plan, const RayInputs& inputs);
  void setUniforms(const Plan& plan, const RayInputs& inputs, const VolumeTextures& textures);
  bool makeTarget(glm::ivec2 size);
  int uniform(const char* name) const;

  Programs programs_;
  unsigned program_ = 0, vertices_ = 0;
  int stepsOfPass_ = 1;
  PictureTarget target_, before_;  ///< of this pass, and what it goes on from
  BufferTexture rays_, curve_, buckets_, factors_, lights_, shades_;
};

}  // namespace volumen
