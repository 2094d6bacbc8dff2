#pragma once

#include <QImage>
#include <optional>
#include <vector>

#include "viewer/slice/colour_map.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// A range of values of a volume, tinted voxel by voxel in one colour.
struct TintedRange {
  ValueRange range;  ///< inclusive
  QRgb colour = 0;
  bool operator==(const TintedRange&) const = default;
};

/// A range of values of a volume.
struct VolumeRange {
  VolumePtr volume;
  ValueRange range;
};

/// A volume in a flat picture, with its grey mapping and opacity.
struct SliceLayer {
  VolumePtr volume;
  GreyMapping grey;
  ColourMap colours = ColourMap::grey;
  double opacity = 1;                   ///< only of layers above the first
  Rigid fromPlane{};                    ///< from the plane's patient space to the volume's
  std::optional<TintedRange> tinted{};  ///< only of the last layers: replaces greys and colours
  bool operator==(const SliceLayer&) const = default;
};

/// Returns the plane of one patient space in another one.
SlicePlane planeMovedBy(SlicePlane plane, const Rigid& rigid);
/// Returns the layers on a plane, first at the bottom, in the pixels of the plane. No layer is tinted;
/// outside is black. The Error is that of resampleSlice().
Result<QImage> sliceImage(const std::vector<SliceLayer>& layers, const SlicePlane& plane);
/// Returns the picture of that plane with a tinted layer over it. The Error is that of resampleSlice().
Result<QImage> withTint(QImage picture, const SliceLayer& layer, SlicePlane plane);

}  // namespace volumen
