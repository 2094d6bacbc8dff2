#pragma once

#include <QString>

#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Returns the name of a plane of a curved reformat (Series::curved), such as "Cross-section".
QString curvedPlaneText(const Series& series, const SlicePlane& plane);

/// Returns a plane's position: "12.5 mm along the curve" (arc length of the drawn curve) or "3 mm off the
/// curve". Empty for oblique planes.
QString curvedPlaceText(const Series& series, const SlicePlane& plane);

/// Returns whether the curve was changed or deleted after the reformat: no curve on the source has its
/// points. False if the source was closed.
bool isOfEarlierCurve(const Workspace& workspace, const Series& series);

}  // namespace volumen
