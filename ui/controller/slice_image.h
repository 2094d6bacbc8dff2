#pragma once

#include <QImage>
#include <optional>
#include <vector>

#include "viewer/slice/colour_map.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// Values of a volume that are tinted in one colour, voxel by voxel.
struct TintedRange {
  ValueRange range;  ///< ends included
  QRgb colour = 0;
  bool operator==(const TintedRange&) const = default;
};

/// Which values of which volume.
struct VolumeRange {
  VolumePtr volume;
  ValueRange range;
};

/// A volume in a flat picture: how its values are shown, and how much is seen of what lies under it.
struct SliceLayer {
  VolumePtr volume;
  GreyMapping grey;
  ColourMap colours = ColourMap::grey;
  double opacity = 1;                   ///< of layers above the first
  Rigid fromPlane{};                    ///< from the plane's patient space to the volume's
  std::optional<TintedRange> tinted{};  ///< of the last layers: in place of its greys and colours
  bool operator==(const SliceLayer&) const = default;
};

/// The layers on one plane, none of them tinted, the first at the bottom, as many pixels as the plane has;
/// black where it lies outside. The Error is that of resampleSlice().
Result<QImage> sliceImage(const std::vector<SliceLayer>& layers, const SlicePlane& plane);
/// The picture of that plane with a tinted layer over it. The Error is the same.
Result<QImage> withTint(QImage picture, const SliceLayer& layer, SlicePlane plane);

}  // namespace volumen
