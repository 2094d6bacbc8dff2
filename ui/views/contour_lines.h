#pragma once

#include <QColor>
#include <QLineF>
#include <QPolygonF>
#include <vector>

#include "io/contours.h"
#include "ui/workspace/regions_look.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// What a plane shows of the contours of one region: whole those that lie in it, of others where it cuts
/// them. Pixels of the plane.
struct ContourLines {
  QColor colour;
  std::vector<QPolygonF> lines;  ///< closed ones end where they begin
  std::vector<QLineF> cuts;      ///< through the inside of closed ones
  std::vector<QPointF> points;   ///< point contours, and where lines are cut
};

/// Of the regions that are shown and lie in this frame of reference. `reachMm`: how far from the plane a
/// contour parallel to it may lie.
std::vector<ContourLines> contourLines(const StructureSet& contours, const RegionsLook& look,
                                       const std::string& frameOfReferenceUid, const SlicePlane& plane,
                                       double reachMm);

}  // namespace volumen
