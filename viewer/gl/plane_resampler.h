#pragma once

#include <array>
#include <utility>

#include "viewer/gl/batch.h"
#include "viewer/gl/program.h"
#include "viewer/gl/target.h"
#include "viewer/gl/timer.h"
#include "viewer/gl/volume_textures.h"

namespace volumen {

/// Resamples batches of rays in a fragment shader and reads them back through pixel buffers (paper 3.1). Two
/// slots let one batch be drawn while another is read back. Needs a current context.
///
/// For 32-bit volumes the shader interpolates with the same operations as the CPU. 16-bit volumes are
/// filtered by the hardware. GPUs keep as few as 8 bits of the position between two voxels (Mesa's llvmpipe
/// keeps all bits of a float). Each of the three interpolations may thus be off by 1/512 of the difference
/// between the neighbours.
class PlaneResampler {
 public:
  /// Sets up programs, targets and buffers for a picture of this plan with batches of up to `lines` lines.
  /// Returns an Error if OpenGL cannot do it.
  Status prepare(const Plan& plan, const VolumeTextures& textures, std::int64_t lines);

  /// Starts to draw the batch into a slot's target. Returns an Error if OpenGL cannot take the batch.
  Status draw(const Batch& batch, int slot);
  /// Starts to read back the slot's target.
  void startReading(const Batch& batch, int slot) { slots_[slot].startReading(batch.lines); }
  /// Returns the samples last read back from the slot, valid until unmap(); null if OpenGL failed.
  SampleTarget::Samples map(int slot);
  void unmap(int slot) { slots_[slot].unmap(); }
  /// Returns the time, in ms, that OpenGL has spent on resampling since the last call.
  double takeGlMs() { return std::exchange(glMs_, 0.0); }

 private:
  Status makeSlots(int lines, bool gradients);
  void freeSlots();

  Programs programs_;
  unsigned program_ = 0;   ///< Program of the picture.
  unsigned vertices_ = 0;  ///< A vertex array without attributes, which core OpenGL requires.
  BufferTexture rays_;
  std::vector<float> rayTexels_;
  std::array<SampleTarget, 2> slots_;
  int lines_ = 0;           ///< Lines of the targets.
  bool gradients_ = false;  ///< True if the targets have gradients.
  GlTimer timer_;
  double glMs_ = 0;
};

}  // namespace volumen
