#include "viewer/measure/two_lines.h"

#include "viewer/measure/lengths.h"

namespace volumen {

Result<Measured> measureTwoLines(const Shape& shape, const VoxelGeometry& geometry, const std::string& unit) {
  const std::span<const glm::dvec3> points = shape.points;
  const Length first = lengthOf(points.first(2), geometry), second = lengthOf(points.last(2), geometry);
  Measured measured;
  measured.lines = TwoLines{first.mm, second.mm, unit};
  if (shape.kind == ShapeKind::cardiothoracic) {
    if (second.mm == 0) return Error{"There is no ratio where the thorax has no width."};
    measured.number = first.mm / second.mm;
    return measured;
  }
  measured.number = first.mm;
  measured.plusMinus = first.plusMinus;
  measured.unit = unit;
  return measured;
}

Status checkRightAngle(std::span<const glm::dvec3> points) {
  const Result<double> angle = angleOf(points, true);
  if (angle && *angle < 89) return Error{"The short axis must be at right angles to the long one."};
  return {};
}

}  // namespace volumen
