#pragma once

#include "viewer/gl/program.h"
#include "viewer/gl/ray_band.h"
#include "viewer/gl/target.h"
#include "viewer/gl/volume_textures.h"
#include "viewer/kernels/trace.h"

namespace volumen {

/// Casts whole rays in one fragment shader. They are resampled, classified after interpolation, shaded and
/// composited front to back (figure 1c of the paper), or composited from preshaded voxels (figure 1b).
/// Computes in floats; 16-bit volumes are filtered by the hardware (see PlaneResampler). Long rays take
/// several passes. Needs a current context.
class Caster {
 public:
  /// Sets up programs, tables and uniforms for a picture.
  Status prepare(const Plan& plan, const RayInputs& inputs, const VolumeTextures& textures);
  /// Draws a band. Returns an Error if OpenGL runs out of memory.
  Status draw(const RayBand& band, float inverseUnitMm);
  /// Returns the band, four floats per pixel, row by row, valid until the next call. Composites:
  /// premultiplied colour and alpha. Extremes: the density and 0. Averages: the sum of density times length,
  /// and the length. Empty if OpenGL failed.
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
  PictureTarget target_, before_;  ///< Target of this pass, and the result of the pass before.
  BufferTexture rays_, curve_, buckets_, factors_, lights_, shades_;
};

}  // namespace volumen
