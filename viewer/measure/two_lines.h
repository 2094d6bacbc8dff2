#pragma once

#include "viewer/measure/measure.h"

namespace volumen {

/// The lengths of both lines of a bidirectional or cardiothoracic shape, and what they come to: the long axis
/// with its +- (lengthOf()), or the heart's width by the thorax's, which has no unit. Whichever was drawn
/// first, the longer one is the long axis, or the thorax. An Error where the line drawn last has no width for
/// a ratio. `unit`: that of the points.
Result<Measured> measureTwoLines(const Shape& shape, const VoxelGeometry& geometry, const std::string& unit);

/// An Error where the lines of these four points are more than 1 degree off a right angle; a line without
/// length has no direction that could be.
Status checkRightAngle(std::span<const glm::dvec3> points);

}  // namespace volumen
