#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_map.h"

namespace volumen {

/// Voxels side by side in a row of a grid: (begin .. end - 1, j, k).
struct RowSpan {
  int begin, end, j, k;
  bool operator==(const RowSpan&) const = default;
};

/// Voxels of a grid, row after row in the order of memory; no two spans touch.
using VoxelSpans = std::vector<RowSpan>;

// What brushes cover. Places are in the patient, mm; the cost is that of the box about the stroke.

/// The voxels whose centre lies within radiusMm of the line between two places.
VoxelSpans ballStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, double radiusMm);

/// What discs in a plane cover that follow each other along a line in it, at most half the finest edge of a
/// voxel apart. A disc covers the voxels that the plane goes through (those that a slice of it shows) and
/// that it reaches farther into than half that edge: of cubes those whose centre lies before or behind it, of
/// longer ones those of which a part does.
VoxelSpans discStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, glm::dvec3 normal,
                      double radiusMm);

/// The voxels that a plane goes through and whose centre lies, along its normal, within an outline in it. The
/// last point is joined to the first; where the outline crosses itself, all that it goes around is inside
/// (non-zero winding number).
VoxelSpans insideOutline(const VoxelGeometry& grid, std::span<const glm::dvec3> outline, glm::dvec3 normal);

/// What painting changes.
struct PaintRules {
  std::uint8_t label = 1;             ///< that is painted, or taken away
  bool erases = false;                ///< voxels of the label become background
  std::vector<std::uint8_t> kept{};   ///< labels that are not painted over; background may be one
  std::optional<ValueRange> range{};  ///< only voxels of these values that are no padding; with a volume
  VolumePtr volume{};                 ///< on the grid of the labels
};

/// With these voxels painted. Bricks that stay the same are shared.
LabelMap painted(const LabelMap& map, const VoxelSpans& spans, const PaintRules& rules);

/// Adds voxels to a mask of their grid.
void addSpans(BitMask& mask, const VoxelSpans& spans);

}  // namespace volumen
