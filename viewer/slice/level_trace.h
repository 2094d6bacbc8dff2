#pragma once

#include <vector>

#include "viewer/slice/slice.h"

namespace volumen {

/// Returns the closed contour at the value under a point of a slice, in pixels. The centre of pixel (x, y) is
/// (x + 1/2, y + 1/2), and the last point joins the first.
/// The value and the contour are interpolated between pixel centres (marching squares; ambiguous cells follow
/// the bilinear function). Pixels of exactly that value are inside. Pixels without a value and beyond the
/// slice are below any value; the contour runs halfway to them. Of several contours, the one with the
/// crossing nearest to the point is returned. Empty if the point has no value.
std::vector<glm::dvec2> levelTrace(const SliceValues& slice, glm::dvec2 at);

}  // namespace volumen
