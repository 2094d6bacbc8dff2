#pragma once

#include <QImage>

#include "results/series/loaded_frame.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Returns the picture of a frame on a plane through its slice. Grey values are mapped by `grey`, colours are
/// unchanged, the surroundings are black. With `withLayers` shutters cover the picture in their grey and
/// overlays are white. An Error is that of checkPlane.
Result<QImage> drawFrame(const LoadedFrame& frame, const SlicePlane& plane, const GreyMapping& grey,
                         bool withLayers);

}  // namespace volumen
