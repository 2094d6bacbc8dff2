#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Neighbouring rays of a picture as the kernels read them: arrays of one entry a ray, padded to whole
/// vectors with rays of no steps. Positions in voxel space; a ray's sample n (SCENE 9) lies at start + (n +
/// 1/2) move, its last one at start + lastMiddle move.
struct RayRow {
  int count = 0;           ///< rays, without the padding at the end
  std::vector<int> pixel;  ///< each ray's place in the picture, y * width + x; -1: padding
  std::vector<float> startX, startY, startZ;
  std::vector<float> moveX, moveY, moveZ;  ///< one step, voxels
  std::vector<float> viewerX, viewerY,
      viewerZ;  ///< unit vector towards the viewer, patient space (SCENE 5: e)
  std::vector<int> steps;
  /// How many steps each ray of a block begins behind the first: with so many ahead of them all come by a
  /// plane across the view at the same step. Whole where samples stand at steps; 0 in rows.
  std::vector<float> ahead;
  std::vector<float> lastMiddle;
  std::vector<float> stepMm, lastStepMm;
  bool parallel = false;  ///< all rays that have steps share what follows
  glm::vec3 sharedMove{0};
  float sharedStepMm = 0;
};

/// Makes the rays of a picture: camera, box, clip box and planes (SCENE 6, 7) in double precision, sampled in
/// steps (SCENE 9).
class RaySetup {
 public:
  static constexpr int padding = 16;  ///< rays a row is padded to a multiple of

  /// `scene` must be complete. `clip` false: the clip box and planes are not looked at.
  RaySetup(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, double stepVoxels, bool clip);
  /// The rays of a plan's picture.
  RaySetup(const Plan& plan, const VoxelGeometry& geometry)
      : RaySetup(plan.scene, geometry, plan.options.size, plan.stepVoxels, plan.clip) {
    wholeAhead_ = plan.mostParts <= 1;
  }

  static constexpr int tile = 4;    ///< rows and columns of a tile; a tile's rays fill the widest vector
  static constexpr int block = 32;  ///< rows and columns of a block of tiles
  /// How far the rays of a tile lie from their middle, in voxels along any axis, at the far end of the
  /// volume.
  double tileSpread() const;
  /// Fills `row` with the rays of the block of pixels from (x, y) on, tile by tile: rays that a kernel takes
  /// together then lie close in both directions, and meet the same blocks and memory.
  void makeBlock(int x, int y, RayRow& row) const;
  /// The same of single tiles: `corners`, their first pixels.
  void makeTiles(const std::vector<glm::ivec2>& corners, RayRow& row) const;
  /// Fills `row` with the rays of `count` pixels of picture row y, from pixel x on.
  void makeRays(int x, int y, int count, RayRow& row) const;

 private:
  struct Plane {
    glm::dvec3 normal;  ///< in voxel space: inside where dot(normal, x) <= offset
    double offset;
  };
  struct Batch;
  static void resize(RayRow& row, int count);
  /// Fills in the rays of row.pixel; padding stays 0. `ahead` is counted from where the camera counts.
  void setRays(RayRow& row) const;
  void countAheadFromFirst(RayRow& row) const;
  void setOrigins(Batch& batch) const;
  void cutIntervals(Batch& batch) const;
  void writeRays(const Batch& batch, RayRow& row, int first) const;

  glm::ivec2 size_;
  double stepVoxels_;
  bool wholeAhead_ = true;  ///< samples stand at steps, none between
  bool perspective_, localViewer_;
  CameraAxes axes_;
  glm::dvec3 eye_, target_;
  double height_;
  VoxelGeometry geometry_;
  glm::dmat3 voxelFromMm_;
  glm::dvec3 low_, high_;  ///< the clipped box, voxel space
  std::vector<Plane> planes_;
};

}  // namespace volumen
