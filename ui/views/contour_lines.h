#pragma once

#include <QColor>
#include <QLineF>
#include <QPolygonF>
#include <vector>

#include "io/contours.h"
#include "ui/workspace/regions_look.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// The contours of one region on a plane, in pixels of the plane. Contours in the plane are shown whole,
/// others where the plane cuts them.
struct ContourLines {
  QColor colour;
  std::vector<QPolygonF> lines;  ///< closed lines end at their first point
  std::vector<QLineF> cuts;      ///< chords through the inside of closed contours
  std::vector<QPointF> points;   ///< point contours, and intersections with open contours
};

/// Returns the contours of the visible regions in this frame of reference. `reachMm` is the largest distance
/// from the plane of a contour parallel to it.
std::vector<ContourLines> contourLines(const StructureSet& contours, const RegionsLook& look,
                                       const std::string& frameOfReferenceUid, const SlicePlane& plane,
                                       double reachMm);

}  // namespace volumen
