#include "viewer/measure/leg_axis.h"

#include <glm/geometric.hpp>

#include "viewer/measure/lengths.h"

namespace volumen {

Result<Measured> measureLegAxis(std::span<const glm::dvec3> points, int outwards) {
  const Result<double> knee = angleOf(points, false);
  if (!knee) return knee.error();
  Measured measured;
  measured.number = 180 - *knee;
  measured.unit = "degrees";
  LegAxis& leg = measured.leg.emplace();
  leg.hka = *knee;
  // Offset of the knee from the line from hip to ankle.
  const glm::dvec3 line = points[2] - points[0], way = points[1] - points[0];
  const double length = glm::dot(line, line);
  const double beside = length > 0 ? (way - line * (glm::dot(way, line) / length)).x : 0;
  leg.bend = beside * outwards > 0   ? LegAxis::Bend::varus
             : beside * outwards < 0 ? LegAxis::Bend::valgus
                                     : LegAxis::Bend::unknown;
  return measured;
}

}  // namespace volumen
