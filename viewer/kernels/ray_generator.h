#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/kernels/generate_rays.h"
#include "viewer/kernels/ray_row.h"
#include "viewer/plan/plan.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Makes the rays of a picture: camera, box, clip box and planes (picture.md 6, 7) in double precision,
/// sampled in steps (picture.md 9).
class RayGenerator {
 public:
  static constexpr int padding = 16;  ///< rays a row is padded to a multiple of

  /// `scene` must be complete. `clip` false: the clip box and planes are not looked at.
  RayGenerator(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, double stepVoxels,
               bool clip);
  /// The rays of a plan's picture.
  RayGenerator(const Plan& plan, const VoxelGeometry& geometry)
      : RayGenerator(plan.scene, geometry, plan.options.size, plan.stepVoxels, plan.clip) {
    // Between steps stand no samples but those of rays that go from cell to cell.
    if (plan.cellByCell) ahead_ = Ahead::exact;
  }

  /// The length of a whole step where all rays have the same: RayRow::stepMm; 0 in perspective.
  float sharedStepMm() const { return float(view_.sharedStepMm); }

  const ViewRays& view() const { return view_; }

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
  /// Of rays that makeBlock made (row.pixel of 16 rays a tile; -1: none) the parts that lie in `parts`.
  void makeParts(const RayParts& parts, RayRow& row) const;
  /// Fills `row` with the rays of `count` pixels of picture row y, from pixel x on.
  void makeRays(int x, int y, int count, RayRow& row) const;

 private:
  static void resize(RayRow& row, int count);

  ViewRays view_;
  VoxelGeometry geometry_;
  glm::dvec3 target_;           ///< patient space
  Ahead ahead_ = Ahead::whole;  ///< of tiles
  GenerateRays makeRays_ = chooseGenerateRays();
};

}  // namespace volumen
