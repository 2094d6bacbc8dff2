#pragma once

#include "viewer/measure/measure.h"
#include "viewer/slice/frame.h"

namespace volumen {

/// A frame to measure on.
struct FramePixels {
  VolumePtr values;       ///< one slice, in the order of the frame; of colour its red
  VolumePtr green, blue;  ///< null: grey
  PixelSize pixel;
  std::vector<UltrasoundRegion> regions;
  int outwards = 0;  ///< of a picture of one side: 1 where rows lead away from the middle of the body, -1
                     ///< towards it; 0: not known

  bool colour() const { return green != nullptr; }
};

/// Measures one shape of a frame (slices.md 4), whose points are pixels: 0, 0 is the centre of the first one.
/// Lengths and areas are mm where PixelSize or the region of ultrasound that holds all points says how large
/// a pixel is, else px: counted along rows and columns, whatever the shape of a pixel. Angles are those of
/// the picture as it is shown. An Error where checkShape() refuses it, an arm has no length, an arrow is
/// asked for its number or a probe lies outside the frame.
Result<Measured> measureOnFrame(const Shape& shape, const FramePixels& frame, const std::string& valueUnit);

/// The shape of a frame in the space of the slice that shows it: patient mm, or where that has no place in
/// the patient mm (px) from its first pixel.
Shape inSliceSpace(Shape ofFrame, const VoxelGeometry& slice);

}  // namespace volumen
