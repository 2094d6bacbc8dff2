#pragma once

#include <QImage>
#include <vector>

#include "viewer/slice/colour_map.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// A volume in a flat picture: how its values are shown, and how much is seen of what lies under it.
struct SliceLayer {
  VolumePtr volume;
  GreyMapping grey;
  ColourMap colours = ColourMap::grey;
  double opacity = 1;  ///< of layers above the first
  Rigid fromPlane{};   ///< from the plane's patient space to the volume's
  bool operator==(const SliceLayer&) const = default;
};

/// The layers on one plane, the first at the bottom, as many pixels as the plane has; black where it lies
/// outside. The Error is that of resampleSlice().
Result<QImage> sliceImage(const std::vector<SliceLayer>& layers, const SlicePlane& plane);

}  // namespace volumen
