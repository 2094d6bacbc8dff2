#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_map.h"

namespace volumen {

/// A run of voxels in a row of a grid: (begin .. end - 1, j, k).
struct RowSpan {
  int begin, end, j, k;
  bool operator==(const RowSpan&) const = default;
};

/// Voxels of a grid as runs, in memory order. No two runs touch.
using VoxelSpans = std::vector<RowSpan>;

// Voxels that brushes cover. Points are in patient space, mm. The cost grows with the bounding box of the
// stroke.

/// Returns the voxels whose centre lies within `radiusMm` of the line from `from` to `to`.
VoxelSpans ballStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, double radiusMm);

/// Returns the voxels covered by discs in a plane, placed along a line at most half the finest voxel edge
/// apart. A disc covers voxels that the plane cuts (those shown in its slice) and that it enters by more than
/// half that edge. The centre of a cubic voxel must lie in the disc, seen along the normal. For longer voxels
/// it is enough that a point at least that far from all their faces does.
VoxelSpans discStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, glm::dvec3 normal,
                      double radiusMm);

/// Returns the voxels that a plane cuts and whose centre, projected along the normal, lies within a closed
/// outline. Self-crossing outlines follow the non-zero winding rule.
VoxelSpans insideOutline(const VoxelGeometry& grid, std::span<const glm::dvec3> outline, glm::dvec3 normal);

/// Rules for the voxels that a brush changes.
struct PaintRules {
  std::uint8_t label = 1;            ///< Label to paint or erase
  bool erases = false;               ///< True if voxels of the label become background
  std::vector<std::uint8_t> kept{};  ///< Labels that are not painted over; may include background
  /// Paints only voxels with values in this range, except padding; needs `volume`.
  std::optional<ValueRange> range{};
  VolumePtr volume{};  ///< Volume on the grid of the labels
};

/// Returns the map with these voxels painted. Unchanged bricks are shared.
LabelMap painted(const LabelMap& map, const VoxelSpans& spans, const PaintRules& rules);

/// Adds voxels to a mask of the same grid.
void addSpans(BitMask& mask, const VoxelSpans& spans);

}  // namespace volumen
