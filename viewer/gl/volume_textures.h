#pragma once

#include <cstddef>
#include <string>

#include "viewer/acceleration/stored_voxels.h"
#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Density and gradients of one volume as 3D textures, in the units of StoredVoxels. In 16 bits: density as
/// normalised R16, counted from the smallest value, and gradients as RGBA16_SNORM, filtered by the hardware.
/// In 32 bits: R32F and RGBA32F, filtered in the shader. Needs a current context.
class VolumeTextures {
 public:
  /// Makes the missing textures that the plan needs. Returns an Error if the volume is too large for OpenGL,
  /// or "cancelled".
  Status load(const Plan& plan, StoredVoxels& voxels, const CancelToken& cancel);

  /// Uploads preshaded voxels, four floats each, filtered in the shader. They serve one picture only.
  Status loadShaded(glm::ivec3 size, const float* rgba, const CancelToken& cancel);

  /// Texture units. sample.glsl uses those below `freeUnit`.
  enum Unit { densityUnit, gradientUnit, freeUnit };
  /// Returns the #define lines for a program of sample.glsl and this plan.
  static std::string defines(const Plan& plan);
  /// Makes such a program current and passes it the textures loaded for the plan.
  void use(unsigned program, const Plan& plan) const;

  std::size_t densityBytes() const { return density_.bytes; }
  std::size_t gradientBytes() const { return gradients_.bytes; }

 private:
  struct Texture {
    unsigned name = 0;
    int bits = 0;  ///< Stored precision; 0: empty.
    std::size_t bytes = 0;
  };
  Status loadDensity(int bits, StoredVoxels& voxels, const CancelToken& cancel);
  Status loadGradients(const Plan& plan, StoredVoxels& voxels, const CancelToken& cancel);

  float rounding() const;

  glm::ivec3 size_{0};
  Texture density_, gradients_, shaded_;
  GradientOperator gradientsBy_ = GradientOperator::sobel;
  int smallest_ = 0, span_ = 0;  ///< Range of 16-bit densities; a texel of 0 stands for the smallest.
};

}  // namespace volumen
