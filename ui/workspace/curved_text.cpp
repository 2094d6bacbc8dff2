#include "ui/workspace/curved_text.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "io/curved.h"
#include "results/series/series_facts.h"
#include "results/text/measured_text.h"
#include "results/text/text.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

// Returns the axis of curved space perpendicular to a plane; empty if the plane is oblique.
std::optional<int> axisAcross(const SlicePlane& plane) {
  const glm::dvec3 normal = glm::abs(plane.normal());
  for (int axis = 0; axis < 3; ++axis)
    if (normal[axis] > 1 - 1e-6) return axis;
  return {};
}

bool isStretched(const Series& series) { return series.curved->recipe.kind == CurvedKind::stretched; }

// Returns the axis along the curve.
int axisAlong(const Series& series) { return isStretched(series) ? 0 : 2; }

// Returns the arc length of the drawn curve at `p`, mm. A stretched reformat is laid out by the length of the
// curve's projection onto a plane.
double alongCurve(const Series& series, glm::dvec3 p) {
  if (!isStretched(series)) return std::abs(p[axisAlong(series)]);
  const Result<CurvedGrid> grid = CurvedGrid::make(series.curved->recipe, drawnGeometry(sourceOf(series)));
  return grid ? grid->alongCurve(p) : std::abs(p[axisAlong(series)]);
}

}  // namespace

QString curvedPlaneText(const Series& series, const SlicePlane& plane) {
  const std::optional<int> axis = axisAcross(plane);
  if (!axis) return tr("Oblique");
  if (*axis == axisAlong(series)) return tr("Cross-section");
  if (!isStretched(series)) return tr("Straightened plane");
  return *axis == 1 ? tr("Stretched plane") : tr("Stretched, from above");
}

QString curvedPlaceText(const Series& series, const SlicePlane& plane) {
  const std::optional<int> axis = axisAcross(plane);
  if (!axis) return {};
  const bool isAlong = *axis == axisAlong(series);
  const double mm = isAlong ? alongCurve(series, plane.centre) : std::abs(plane.centre[*axis]);
  const QString text = shortNumberText(std::round(10 * mm) / 10);
  return isAlong ? tr("%1 mm along the curve").arg(text) : tr("%1 mm off the curve").arg(text);
}

bool isOfEarlierCurve(const Workspace& workspace, const Series& series) {
  if (!workspace.series.contains(keyOf(sourceOf(series)))) return false;
  const std::vector<glm::dvec3>& points = series.curved->recipe.points;
  return std::ranges::none_of(workspace.measurements, [&](const Measurement& m) {
    return m.shape.kind == ShapeKind::openCurve && m.series == keyOf(sourceOf(series)) &&
           (m.shape.points == points ||
            std::equal(m.shape.points.rbegin(), m.shape.points.rend(), points.begin(), points.end()));
  });
}

}  // namespace volumen
