#pragma once

#include <span>

#include "viewer/measure/measure.h"

namespace volumen {

/// How far a leg is from straight, 180 degrees less the angle at the knee between the lines to the hip and to
/// the ankle (the mechanical axis: Paley, Principles of Deformity Correction, 2002, chapter 1), with LegAxis.
/// `points`: the centres of hip, knee and ankle. `outwards`: 1 where x leads away from the middle of the
/// body, -1 towards it, 0: not known. An Error where two of the points are one.
Result<Measured> measureLegAxis(std::span<const glm::dvec3> points, int outwards);

}  // namespace volumen
