#include "viewer/measure/two_lines.h"

#include <utility>

#include "viewer/measure/lengths.h"

namespace volumen {

Result<Measured> measureTwoLines(const Shape& shape, const VoxelGeometry& geometry, const std::string& unit) {
  const std::span<const glm::dvec3> points = shape.points;
  Length longer = lengthOf(points.first(2), geometry), shorter = lengthOf(points.last(2), geometry);
  Measured measured;
  if (shape.kind == ShapeKind::cardiothoracic && shorter.mm == 0)
    return Error{"There is no ratio where the thorax has no width."};
  if (longer.mm < shorter.mm) std::swap(longer, shorter);
  if (shape.kind == ShapeKind::cardiothoracic) {
    measured.lines = TwoLines{shorter.mm, longer.mm, unit};
    measured.number = shorter.mm / longer.mm;
    return measured;
  }
  measured.lines = TwoLines{longer.mm, shorter.mm, unit};
  measured.number = longer.mm;
  measured.plusMinus = longer.plusMinus;
  measured.unit = unit;
  return measured;
}

Status checkRightAngle(std::span<const glm::dvec3> points) {
  const Result<double> angle = angleOf(points, true);
  if (angle && *angle < 89) return Error{"The short axis must be at right angles to the long one."};
  return {};
}

}  // namespace volumen
