#pragma once

#include <vector>

#include "viewer/gl/program.h"
#include "viewer/kernels/ray_generator.h"

namespace volumen {

/// Whole rows of a picture and their rays, as many as OpenGL takes at once. Pixel (x, row) of a target
/// belongs to ray x of rows[row]. Rows are padded to `stride` pixels with rays without steps.
struct RayBand {
  std::vector<RayRow> rows;
  int stride = 0, longest = 0;  ///< longest: largest number of steps of a ray.
  bool empty() const { return rows.empty(); }
};

/// Cuts a picture into bands from the top.
class RayBands {
 public:
  /// `drawnSteps`: largest number of samples per ray and draw call. One draw call must not run so long that
  /// the GPU's driver aborts it.
  RayBands(const RayGenerator& setup, glm::ivec2 size, std::int64_t drawnSteps)
      : setup_(setup), size_(size), drawnSteps_(drawnSteps) {}

  /// Returns the number of rows of the largest band. Needs a current context and respects its limits.
  int rows() const;
  /// Computes the rays of the next band on all cores; leaves it empty at the end of the picture.
  void fill(RayBand& band, int threads);

 private:
  const RayGenerator& setup_;
  glm::ivec2 size_;
  std::int64_t drawnSteps_;
  int next_ = 0;
};

/// Uploads a band's rays for shaders (ray.glsl).
Status uploadRays(const RayBand& band, float inverseUnitMm, BufferTexture& to);

}  // namespace volumen
