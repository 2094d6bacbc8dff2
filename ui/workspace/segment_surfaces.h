#pragma once

#include <QString>
#include <memory>
#include <vector>

#include "ui/workspace/segment_map.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"

namespace volumen {

struct Workspace;

/// The 3D surface of a segment, and what it was made from.
struct MadeSurface {
  SeriesKey series;
  int map = 0;                                    ///< index among the maps of the series
  int number = 0;                                 ///< number of the segment in that map
  std::shared_ptr<const LabelMap> labels;         ///< the labels of its voxels
  Mask mask;                                      ///< the mask applied to them
  std::shared_ptr<const OccupancyField> field{};  ///< null: could not be made
  QString whyNot{};                               ///< the reason, as a sentence

  /// Returns whether both belong to the same segment.
  bool isOfSame(const MadeSurface& other) const {
    return series == other.series && map == other.map && number == other.number;
  }
};

/// A segment drawn in a 3D view.
struct SegmentInScene {
  const Segment* segment;  ///< points into the workspace
  std::shared_ptr<const OccupancyField> field;
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
SegmentSurface surfaceOf(const Segment& segment, std::shared_ptr<const OccupancyField> field);

/// Returns whether the segment of a surface still exists and its series is in a 3D view on screen.
bool isOfSegmentOnScreen(const MadeSurface& surface, const Workspace& workspace);

}  // namespace volumen
