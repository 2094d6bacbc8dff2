#pragma once

#include <span>
#include <utility>

#include "ui/document/derivation.h"
#include "ui/workspace/segment_surfaces.h"
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

/// Returns the memory limit for the fields of all surfaces: a quarter of the machine's memory.
std::size_t mostSurfaceBytes();

/// Returns the segments of a series' maps as 3D views show them, on the grid of its volume, within
/// `mostBytes`. Maps without labels or on another grid have none. `whole` is the unmasked volume; `mask` is
/// applied. An Error is the reason why a segment is not drawn. Slow. After a cancellation some are missing.
std::vector<std::pair<SurfaceKey, Result<FieldPtr>>> surfacesOf(std::span<const SegmentMap> maps,
                                                                const Volume& whole, const Mask& mask,
                                                                std::size_t mostBytes,
                                                                const CancelToken& cancel = {});

}  // namespace volumen
