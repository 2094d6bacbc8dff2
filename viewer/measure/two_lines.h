#pragma once

#include "viewer/measure/measure.h"

namespace volumen {

/// Measures both lines of a bidirectional or cardiothoracic shape. The number is the long axis with its +-
/// (lengthOf()), or the ratio of the heart's width to the thorax's, without unit. The longer line is the long
/// axis, or the thorax, whichever was drawn first. Returns an Error if a ratio's line drawn last has no
/// width. `unit`: that of the points.
Result<Measured> measureTwoLines(const Shape& shape, const VoxelGeometry& geometry, const std::string& unit);

/// Returns an Error if the lines of these four points are more than 1 degree off a right angle. A line
/// without length has no direction and passes.
Status checkRightAngle(std::span<const glm::dvec3> points);

}  // namespace volumen
