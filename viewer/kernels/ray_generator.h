#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/kernels/generate_rays.h"
#include "viewer/kernels/ray_row.h"
#include "viewer/plan/plan.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Generates the rays of a picture: camera, box, clip box and planes (picture.md 6, 7) in double precision,
/// sampled in steps (picture.md 9).
class RayGenerator {
 public:
  static constexpr int padding = 16;  ///< Rows are padded to a multiple of this many rays.

  /// `scene` must be complete. `clip` false: ignores the clip box and planes.
  RayGenerator(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, double stepVoxels,
               bool clip);
  /// Generates the rays of a plan's picture.
  RayGenerator(const Plan& plan, const VoxelGeometry& geometry)
      : RayGenerator(plan.scene, geometry, plan.options.size, plan.stepVoxels, plan.clip) {
    // Only rays that go from cell to cell have samples between steps.
    if (plan.cellByCell) ahead_ = Ahead::exact;
  }

  /// Returns the length of a whole step (RayRow::stepMm) if all rays share it; 0 in perspective.
  float sharedStepMm() const { return float(view_.sharedStepMm); }

  const ViewRays& view() const { return view_; }

  static constexpr int tile = 4;    ///< Rows and columns of a tile; a tile's rays fill the widest vector.
  static constexpr int block = 32;  ///< Rows and columns of a block of tiles.
  /// Returns the largest distance, along any axis and in voxels, of a tile's rays from their middle at the
  /// far end of the volume.
  double tileSpread() const;
  /// Fills `row` with the rays of the block of pixels from (x, y) on, tile by tile. Rays that a kernel takes
  /// together then lie close in both directions, and meet the same blocks and memory.
  void makeBlock(int x, int y, RayRow& row) const;
  /// Fills `row` with the rays of single tiles. `corners`: their first pixels.
  void makeTiles(const std::vector<glm::ivec2>& corners, RayRow& row) const;
  /// Fills `row` with the rays of `pixels`, 16 per tile; -1 for no ray.
  void makePixels(std::vector<int> pixels, RayRow& row) const;
  /// Shortens rays made by makeBlock to `parts`. row.pixel: 16 rays per tile, -1 for no ray.
  void makeParts(const RayParts& parts, RayRow& row) const;
  /// Fills `row` with the rays of `count` pixels of picture row y, from pixel x on.
  void makeRays(int x, int y, int count, RayRow& row) const;

 private:
  static void resize(RayRow& row, int count);
  void make(std::vector<int> pixels, const RayParts* parts, RayRow& row) const;

  ViewRays view_;
  VoxelGeometry geometry_;
  glm::dvec3 target_;           ///< Patient space.
  Ahead ahead_ = Ahead::whole;  ///< Value of RayRow::ahead in tiles.
  GenerateRays makeRays_ = chooseGenerateRays();
};

}  // namespace volumen
