#pragma once

#include <array>
#include <utility>

#include "viewer/gl/batch.h"
#include "viewer/gl/program.h"
#include "viewer/gl/target.h"
#include "viewer/gl/timer.h"
#include "viewer/gl/volume_textures.h"

namespace volumen {

/// Resamples batches of rays in a fragment shader and brings them back through pixel buffers (paper 3.1).
/// Two slots, so that one batch can be drawn while another is on its way back. Needs a current context.
///
/// Stored in 32 bits, the shader interpolates with the CPU's own operations. Stored in 16 bits, the hardware
/// filters: GPUs keep as few as 8 bits of the place between two voxels (Mesa's llvmpipe all bits of a float),
/// so each of the three interpolations may be off by 1/512 of the difference between the neighbours.
class PlaneResampler {
 public:
  /// Programs, targets and buffers for a picture of this plan with batches of up to `lines` lines. An Error
  /// where OpenGL cannot do it.
  Status prepare(const Plan& plan, const VolumeTextures& textures, std::int64_t lines);

  /// Starts to draw the batch into a slot's target. An Error where OpenGL takes no such batch.
  Status draw(const Batch& batch, int slot);
  /// Starts to bring what was drawn there back.
  void startReading(const Batch& batch, int slot) { slots_[slot].startReading(batch.lines); }
  /// The samples last brought back from the slot, until unmap(); null where OpenGL failed.
  SampleTarget::Samples map(int slot);
  void unmap(int slot) { slots_[slot].unmap(); }
  /// What OpenGL took to resample since this was last asked, ms.
  double takeGlMs() { return std::exchange(glMs_, 0.0); }

 private:
  Status makeSlots(int lines, bool gradients);
  void freeSlots();

  Programs programs_;
  unsigned program_ = 0;   ///< the picture's
  unsigned vertices_ = 0;  ///< vertex array without attributes, which core OpenGL asks for
  BufferTexture rays_;
  std::vector<float> rayTexels_;
  std::array<SampleTarget, 2> slots_;
  int lines_ = 0;           ///< of the targets
  bool gradients_ = false;  ///< the targets have them
  GlTimer timer_;
  double glMs_ = 0;
};

}  // namespace volumen
