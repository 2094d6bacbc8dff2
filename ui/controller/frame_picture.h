#pragma once

#include <QImage>

#include "ui/data/loaded_frame.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// A frame on a plane through its slice: grey by `grey`, colours as they are; black around it; where
/// `withLayers`, shutters hide behind their grey and overlays are white. An Error for what checkPlane
/// refuses.
Result<QImage> drawFrame(const LoadedFrame& frame, const SlicePlane& plane, const GreyMapping& grey,
                         bool withLayers);

}  // namespace volumen
