#include "ui/workspace/curved_text.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "io/curved.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// The axis of the curved space that a plane stands at right angles to; none: it is oblique.
std::optional<int> axisAcross(const SlicePlane& plane) {
  const glm::dvec3 normal = glm::abs(plane.normal());
  for (int axis = 0; axis < 3; ++axis)
    if (normal[axis] > 1 - 1e-6) return axis;
  return {};
}

bool isStretched(const Series& series) { return series.curved->recipe.kind == CurvedKind::stretched; }

// The axis that runs along the curve.
int axisAlong(const Series& series) { return isStretched(series) ? 0 : 2; }

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
  const QString mm = shortNumberText(std::round(10 * std::abs(plane.centre[*axis])) / 10);
  return *axis == axisAlong(series) ? tr("%1 mm along the curve").arg(mm) : tr("%1 mm off the curve").arg(mm);
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
