#pragma once

#include <QString>
#include <memory>
#include <vector>

#include "ui/workspace/segment_map.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"

namespace volumen {

struct Workspace;

/// What a segment is drawn by in 3D, and what that was made of.
struct MadeSurface {
  SeriesKey series;
  int map = 0;                                    ///< which of the maps of the series
  int number = 0;                                 ///< of the segment in it
  std::shared_ptr<const LabelMap> labels;         ///< that held its voxels
  Mask mask;                                      ///< what was taken away of them
  std::shared_ptr<const OccupancyField> field{};  ///< null: it was not made
  QString whyNot{};                               ///< a sentence, where it was not

  /// Whether both are of one segment.
  bool isOfSame(const MadeSurface& other) const {
    return series == other.series && map == other.map && number == other.number;
  }
};

/// A segment as it is drawn in a 3D view.
struct SegmentInScene {
  const Segment* segment;  ///< of the workspace
  std::shared_ptr<const OccupancyField> field;
};

/// A segment that is to be drawn in a 3D view and is not.
struct SegmentNotDrawn {
  const Segment* segment;  ///< of the workspace
  QString whyNot;
};

/// Says which they are, and why, a line a reason; empty where there are none.
QString notDrawnText(const std::vector<SegmentNotDrawn>& segments);

/// The segments of a map that are to be drawn in 3D: those shown that are not wholly transparent; none of a
/// map that is in slices alone.
std::vector<const Segment*> segmentsIn3d(const SegmentMap& map);

/// A segment's surface in its colour, as it is drawn.
SegmentSurface surfaceOf(const Segment& segment, std::shared_ptr<const OccupancyField> field);

/// Whether the segment that a surface was made of is still there, and its series in a 3D view on screen.
bool isOfSegmentOnScreen(const MadeSurface& surface, const Workspace& workspace);

}  // namespace volumen
