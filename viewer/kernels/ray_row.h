#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// Neighbouring rays of a picture as the kernels read them: arrays of one entry per ray, padded to whole
/// vectors with rays without steps. Positions are in voxel space. Sample n of a ray (picture.md 9) lies at
/// start + (n + 1/2) move, its last one at start + lastMiddle move.
struct RayRow {
  int count = 0;           ///< Number of rays without the padding at the end.
  std::vector<int> pixel;  ///< Pixel of each ray in the picture, y * width + x; -1: padding.
  std::vector<float> startX, startY, startZ;
  std::vector<float> moveX, moveY, moveZ;  ///< Per step, in voxels.
  /// Unit vector towards the viewer in patient space (e of picture.md 5).
  std::vector<float> viewerX, viewerY, viewerZ;
  std::vector<int> steps;
  /// Number of steps by which each ray of a block begins behind the first. With this offset all rays cross a
  /// plane parallel to the picture at the same step. Whole numbers if samples stand at steps; 0 in rows.
  std::vector<float> ahead;
  std::vector<float> lastMiddle;  ///< -1 for rays without steps, so that they end before they begin.
  std::vector<float> stepMm, lastStepMm;
  bool parallel = false;  ///< True if all rays with steps share the values below.
  glm::vec3 sharedMove{0};
  float sharedStepMm = 0;
};

}  // namespace volumen
