#pragma once

#include <QString>
#include <memory>
#include <vector>

#include "ui/workspace/segment_map.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"

namespace volumen {

struct Workspace;

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

/// Returns the series in 3D views on screen.
std::vector<SeriesKey> seriesIn3d(const Workspace& workspace);

}  // namespace volumen
