#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// Neighbouring rays of a picture as the kernels read them: arrays of one entry a ray, padded to whole
/// vectors with rays of no steps. Positions in voxel space; a ray's sample n (picture.md 9) lies at start +
/// (n + 1/2) move, its last one at start + lastMiddle move.
struct RayRow {
  int count = 0;           ///< rays, without the padding at the end
  std::vector<int> pixel;  ///< each ray's place in the picture, y * width + x; -1: padding
  std::vector<float> startX, startY, startZ;
  std::vector<float> moveX, moveY, moveZ;  ///< one step, voxels
  std::vector<float> viewerX, viewerY,
      viewerZ;  ///< unit vector towards the viewer, patient space (picture.md 5: e)
  std::vector<int> steps;
  /// How many steps each ray of a block begins behind the first: with so many ahead of them all come by a
  /// plane across the view at the same step. Whole where samples stand at steps; 0 in rows.
  std::vector<float> ahead;
  std::vector<float> lastMiddle;  ///< -1 of rays of no steps, so that they end before they begin
  std::vector<float> stepMm, lastStepMm;
  bool parallel = false;  ///< all rays that have steps share what follows
  glm::vec3 sharedMove{0};
  float sharedStepMm = 0;
};

}  // namespace volumen
