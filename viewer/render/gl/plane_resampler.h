#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <utility>

#include "viewer/render/gl/batch.h"
#include "viewer/render/gl/timer.h"
#include "viewer/render/gl/volume_textures.h"

namespace volumen {

/// Resamples batches of rays in a fragment shader and brings them back through pixel buffers (paper 3.1).
/// Two slots, so that one batch can be drawn while another is on its way back. Needs a current context.
///
/// Stored in 32 bits, the shader interpolates with the CPU's own operations. Stored in 16 bits, the hardware
/// filters: GPUs keep as few as 8 bits of the place between two voxels (Mesa's llvmpipe all bits of a float),
/// so each of the three interpolations may be off by 1/512 of the difference between the neighbours.
class PlaneResampler {
 public:
  static constexpr int slots = 2;

  /// Programs, targets and buffers for a frame of this plan with batches of up to `lines` lines. An Error
  /// where OpenGL cannot do it.
  Status prepare(const Plan& plan, const VolumeTextures& textures, glm::ivec3 size, std::int64_t lines);

  /// Starts to draw the batch into a slot's target.
  void draw(const Batch& batch, int slot);
  /// Starts to bring what was drawn there back.
  void startReading(const Batch& batch, int slot);
  /// The samples of the batch last brought back from the slot, until unmap(): densities and, where the plan
  /// has gradients, 4 floats a sample. Null where OpenGL failed.
  struct Samples {
    const float *density = nullptr, *gradients = nullptr;
  };
  Samples map(const Batch& batch, int slot);
  void unmap(int slot);
  /// What OpenGL took to resample since this was last asked, ms.
  double takeGlMs() { return std::exchange(glMs_, 0.0); }

 private:
  struct Slot {
    unsigned framebuffer = 0, density = 0, gradients = 0;  ///< target and its textures
    unsigned pixels = 0;                                   ///< pixel buffer
  };
  Status chooseProgram(bool shaderFilter);
  Status makeSlot(Slot& slot);
  void freeSlots();

  std::array<unsigned, 4> programs_{};  ///< by 2 * (filtered in the shader) + (gradients)
  unsigned program_ = 0;                ///< the frame's
  unsigned vertices_ = 0;               ///< vertex array without attributes, which core OpenGL asks for
  unsigned rayBuffer_ = 0, rayTexture_ = 0;
  std::vector<float> rayTexels_;
  std::array<Slot, slots> slots_;
  int lines_ = 0;           ///< of the targets
  bool gradients_ = false;  ///< the targets have them
  GlTimer timer_;
  double glMs_ = 0;
};

}  // namespace volumen
