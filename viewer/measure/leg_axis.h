#pragma once

#include <span>

#include "viewer/measure/measure.h"

namespace volumen {

/// Measures the deviation of a leg from straight, with LegAxis. It is 180 degrees minus the angle at the knee
/// between the lines to hip and ankle (the mechanical axis: Paley, Principles of Deformity Correction, 2002,
/// chapter 1). `points`: the centres of hip, knee and ankle. `outwards`: 1 if x leads away from the middle of
/// the body, -1 if towards it, 0 if unknown. Returns an Error if hip or ankle coincides with the knee.
Result<Measured> measureLegAxis(std::span<const glm::dvec3> points, int outwards);

}  // namespace volumen
