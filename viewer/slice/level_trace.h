#pragma once

#include <vector>

#include "viewer/slice/slice.h"

namespace volumen {

/// The closed line at the value under a place of a slice: its points in pixels (the centre of pixel (x, y) is
/// (x + 1/2, y + 1/2)), the last joined to the first. The value is interpolated between the centres of
/// pixels, and so is the line (marching squares; where a cell can be parted in two ways, as the bilinear
/// function is). Pixels of that value are within it. Pixels without a value, and all beyond the slice, are
/// below any; the line lies half way to them. Of several lines the one of which a crossing between two pixels
/// is nearest to the place; empty where there is no value there.
std::vector<glm::dvec2> levelTrace(const SliceValues& slice, glm::dvec2 at);

}  // namespace volumen
