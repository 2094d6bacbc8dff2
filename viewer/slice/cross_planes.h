#pragma once

#include <vector>

#include "viewer/slice/plane.h"
#include "viewer/slice/smooth_curve.h"

namespace volumen {

/// Returns planes like `like` at right angles to a curve, centred on it, `distanceMm` (above 0) of arc length
/// apart from its start on. The first is seen from the side of the axial, coronal or sagittal plane that is
/// closest to it, with its top on top; from there they turn about the curve as little as possible
/// (carriedAcross()).
std::vector<SlicePlane> planesAcross(const SmoothCurve& curve, const SlicePlane& like, double distanceMm);

}  // namespace volumen
