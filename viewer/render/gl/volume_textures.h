#pragma once

#include <cstddef>

#include "viewer/plan/plan.h"
#include "viewer/render/render.h"

namespace volumen {

/// Density and gradients of one volume as 3D textures, in the units of the CPU's stores (caches.h). Stored
/// in 16 bits: density normalised R16, counted from the smallest, and gradients RGBA16_SNORM, filtered by the
/// hardware.
/// In 32 bits: R32F and RGBA32F, filtered in the shader. Needs a current context.
class VolumeTextures {
 public:
  /// Makes what the plan needs and is not there yet. An Error where the volume is too large for OpenGL, or
  /// "cancelled".
  Status load(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

  /// Preshaded voxels, four floats each, filtered in the shader. Not kept for another picture.
  Status loadShaded(glm::ivec3 size, const float* rgba, const CancelToken& cancel);

  unsigned density() const { return density_.name; }
  unsigned gradients() const { return gradients_.name; }
  /// What a texel of 0 stands for, of densities in 16 bits.
  int smallest() const { return smallest_; }
  unsigned shaded() const { return shaded_.name; }
  /// A texel's way to 0..1 and back, and its interpolation, round densities in 16 bits by less than this.
  float rounding() const;
  std::size_t densityBytes() const { return density_.bytes; }
  std::size_t gradientBytes() const { return gradients_.bytes; }

 private:
  struct Texture {
    unsigned name = 0;
    int bits = 0;  ///< stored precision; 0: nothing is in it
    std::size_t bytes = 0;
  };
  Status loadDensity(int bits, RenderCaches& caches, const CancelToken& cancel);
  Status loadGradients(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

  Texture density_, gradients_, shaded_;
  GradientOperator gradientsBy_ = GradientOperator::sobel;
  int smallest_ = 0, span_ = 0;
};

}  // namespace volumen
