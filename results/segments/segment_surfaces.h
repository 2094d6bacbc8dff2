#pragma once

#include <QString>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "results/segments/segment_map.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Inputs of the 3D surface of a segment.
struct SurfaceKey {
  SeriesKey series;
  int map = 0;                             ///< index among the maps of the series
  int number = 0;                          ///< number of the segment in that map
  std::shared_ptr<const LabelMap> labels;  ///< the labels of its voxels
  Mask mask;                               ///< the mask applied to them

  bool operator==(const SurfaceKey&) const = default;
  /// Returns whether both belong to the same segment.
  bool isOfSame(const SurfaceKey& other) const {
    return series == other.series && map == other.map && number == other.number;
  }
};

using FieldPtr = std::shared_ptr<const OccupancyField>;

/// A segment drawn in a 3D view.
struct SegmentInScene {
  const Segment* segment;  ///< points into the workspace
  FieldPtr field;
};

/// A segment that should be drawn in a 3D view but is not.
struct SegmentNotDrawn {
  const Segment* segment;  ///< points into the workspace
  QString whyNot;
};

/// Returns these segments with the reasons, one line per reason; empty if there are none.
QString notDrawnText(const std::vector<SegmentNotDrawn>& segments);

/// Returns the segments of a map to draw in 3D: those shown and not fully transparent. Empty for a map drawn
/// only in slices.
std::vector<const Segment*> segmentsIn3d(const SegmentMap& map);

/// Returns a segment's surface in its colour.
SegmentSurface surfaceOf(const Segment& segment, FieldPtr field);
/// Returns the keys of a map's surfaces under a mask.
std::vector<SurfaceKey> surfaceKeysOf(const SegmentMap& map, const Mask& mask);

/// The last field of a segment under the same mask, and its labels.
struct SurfaceBefore {
  std::shared_ptr<const LabelMap> labels;
  FieldPtr field;  ///< null: there is none
};
/// Returns the field of a segment, or that of `before` if no voxel has changed. `kept` restricts its voxels;
/// null keeps all. The Error says that the field would exceed `mostBytes`. Slow.
Result<FieldPtr> surfaceFieldOf(const SurfaceKey& key, const SurfaceBefore& before, const BitMask* kept,
                                std::size_t mostBytes, const CancelToken& cancel = {});
std::size_t bytesOf(const OccupancyField& field);

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
