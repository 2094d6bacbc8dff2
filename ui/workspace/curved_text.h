#pragma once

#include <QString>

#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Of a series along a curve (Series::curved): which of its planes this is, "Cross-section".
QString curvedPlaneText(const Series& series, const SlicePlane& plane);

/// Where it lies: "12.5 mm along the curve", of its arc length as it was drawn, "3 mm off the curve"; empty
/// for one that is oblique.
QString curvedPlaceText(const Series& series, const SlicePlane& plane);

/// Whether no curve on its source runs as this series was laid out: it was changed or deleted since. False
/// where the source was closed.
bool isOfEarlierCurve(const Workspace& workspace, const Series& series);

}  // namespace volumen
