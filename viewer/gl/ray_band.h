#pragma once

#include <vector>

#include "viewer/gl/program.h"
#include "viewer/kernels/ray_generator.h"

namespace volumen {

/// Whole rows of a picture and their rays, as many as OpenGL takes at a time. Pixel (x, row) of a target
/// belongs to ray x of rows[row]; rows are padded to `stride` pixels with rays of no steps.
struct RayBand {
  std::vector<RayRow> rows;
  int stride = 0, longest = 0;  ///< longest: most steps of a ray
  bool empty() const { return rows.empty(); }
};

/// Cuts a picture into bands from the top.
class RayBands {
 public:
  /// `drawnSteps`: the most samples of a ray that are drawn in one go, which must not take a GPU so long that
  /// its driver gives up.
  RayBands(const RayGenerator& setup, glm::ivec2 size, std::int64_t drawnSteps)
      : setup_(setup), size_(size), drawnSteps_(drawnSteps) {}

  /// Rows of the largest band. Needs a current context, whose limits it keeps.
  int rows() const;
  /// Makes the rays of the next band on all cores; leaves it empty where the picture is done.
  void fill(RayBand& band, int threads);

 private:
  const RayGenerator& setup_;
  glm::ivec2 size_;
  std::int64_t drawnSteps_;
  int next_ = 0;
};

/// Hands a band's rays to shaders (ray.glsl).
Status uploadRays(const RayBand& band, float inverseUnitMm, BufferTexture& to);

}  // namespace volumen
