#pragma once

#include <optional>
#include <vector>

#include "viewer/kernels/ray_generator.h"

namespace volumen {

/// Neighbouring rays of a picture row that are resampled together. Sample n of ray r is entry n * stride + r
/// of the strip's samples, which begin at a whole line of the target.
struct Strip {
  int strideLog2 = 0;  ///< log2 of the samples per step: the rays, padded to a power of two.
  int firstLine = 0, lines = 0;
  RayRow rays;
  int stride() const { return 1 << strideLog2; }
};

/// Strips that are resampled in one draw call.
struct Batch {
  static constexpr int lineLog2 = 10, line = 1 << lineLog2;  ///< Samples per line.
  static constexpr int mostRays = 1 << 14;  ///< Two texels per ray, of the 65536 that every OpenGL has.
  std::vector<Strip> strips;
  int lines = 0, rays = 0;  ///< Totals of all strips; rays include padding.
  bool empty() const { return strips.empty(); }
};

/// Returns the largest number of samples of a ray: no ray is longer than the volume's diagonal.
std::int64_t mostSteps(glm::ivec3 size, double stepVoxels);

/// Cuts a picture into strips, row by row, and packs them into batches.
class BatchMaker {
 public:
  /// `mostSteps`: upper bound on the steps of a ray.
  BatchMaker(const RayGenerator& setup, glm::ivec2 size, std::int64_t mostSteps);

  /// Returns the largest number of lines of a batch: about a million samples, or those of the longest rays if
  /// they need more.
  std::int64_t lines() const { return lines_; }
  /// Fills the batch with the next strips; leaves it empty at the end of the picture.
  void fill(Batch& batch);

 private:
  Strip nextStrip();

  const RayGenerator& setup_;
  glm::ivec2 size_, next_{0, 0};  ///< next_: first pixel of the next strip.
  int widest_ = 64;               ///< Rays per strip.
  std::int64_t lines_ = 1024;
  std::optional<Strip> waiting_;  ///< The strip that did not fit into the last batch.
};

}  // namespace volumen
