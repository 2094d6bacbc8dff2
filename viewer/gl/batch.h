#pragma once

#include <optional>
#include <vector>

#include "viewer/kernels/ray_generator.h"

namespace volumen {

/// Neighbouring rays of a picture row, resampled together. Sample n of ray r lies at n * stride + r of the
/// strip's samples; these begin at a whole line of the target.
struct Strip {
  int strideLog2 = 0;  ///< log2 of the samples a step: the rays padded to a power of two
  int firstLine = 0, lines = 0;
  RayRow rays;
  int stride() const { return 1 << strideLog2; }
};

/// What is resampled in one go.
struct Batch {
  static constexpr int lineLog2 = 10, line = 1 << lineLog2;  ///< samples a line
  static constexpr int mostRays = 1 << 14;  ///< two texels each of the 65536 that every OpenGL has
  std::vector<Strip> strips;
  int lines = 0, rays = 0;  ///< in all strips; rays with padding
  bool empty() const { return strips.empty(); }
};

/// The most samples that a ray can have: none is longer than the volume's diagonal.
std::int64_t mostSteps(glm::ivec3 size, double stepVoxels);

/// Cuts a picture into strips, row by row, and packs them into batches.
class BatchMaker {
 public:
  /// `mostSteps`: no ray has more.
  BatchMaker(const RayGenerator& setup, glm::ivec2 size, std::int64_t mostSteps);

  /// Lines that a batch holds at most: about a million samples, or the longest rays' where that is more.
  std::int64_t lines() const { return lines_; }
  /// Fills the batch with the next strips; leaves it empty where the picture is done.
  void fill(Batch& batch);

 private:
  Strip nextStrip();

  const RayGenerator& setup_;
  glm::ivec2 size_, next_{0, 0};  ///< next_: first pixel of the next strip
  int widest_ = 64;               ///< rays a strip
  std::int64_t lines_ = 1024;
  std::optional<Strip> waiting_;  ///< did not fit into the last batch
};

}  // namespace volumen
