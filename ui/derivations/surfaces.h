#pragma once

#include <span>
#include <utility>

#include "results/segments/segment_surfaces.h"
#include "ui/document/derivation.h"
#include "ui/workspace/session.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

class SegmentPainter;

/// The voxels of a series that a mask leaves.
struct KeptKey {
  SeriesKey series;
  Mask mask;
  VoxelGeometry grid;
  bool operator==(const KeptKey&) const = default;
};

using KeptVoxels = Derivation<KeptKey, BitMask>;
/// Fields that draw segments in 3D.
using SurfaceFields = Derivation<SurfaceKey, OccupancyField>;

/// Returns the rule for the kept voxels of masked series whose segments are in 3D views on screen. Series
/// that are not in memory as a whole have none.
KeptVoxels::Rule keptVoxelsRule(const Session& session);

/// Returns the rule for the fields of segments in 3D views on screen. A stroke is included once it ends. All
/// fields together have at most `mostBytes`. Fields of hidden segments stay while there is room. `fields` is
/// the derivation that follows this rule.
SurfaceFields::Rule surfaceFieldsRule(const Session& session, const SegmentPainter& painter,
                                      const KeptVoxels& kept, const SurfaceFields& fields,
                                      std::size_t mostBytes);

}  // namespace volumen
