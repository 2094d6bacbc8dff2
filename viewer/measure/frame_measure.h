#pragma once

#include "viewer/measure/measure.h"
#include "viewer/slice/frame.h"

namespace volumen {

/// A frame to measure on.
struct FramePixels {
  VolumePtr values;       ///< One slice, in the order of the frame. The red component of colour frames.
  VolumePtr green, blue;  ///< Null for grey frames.
  PixelSize pixel;
  std::vector<UltrasoundRegion> regions;
  /// For a picture of one side: 1 if rows lead away from the middle of the body, -1 if towards it. 0:
  /// unknown.
  int outwards = 0;

  bool colour() const { return green != nullptr; }
};

/// Measures one shape of a frame (slices.md 4). Its points are pixels; (0, 0) is the centre of the first one.
/// Lengths and areas are in mm if PixelSize gives the size of a pixel, or an ultrasound region that holds all
/// points. Otherwise they are in px, counted along rows and columns whatever the shape of a pixel. Angles are
/// those of the picture as displayed. Returns an Error if checkShape() refuses the shape or an arm has no
/// length. Arrows, labels and probes outside the frame are Errors, too.
Result<Measured> measureOnFrame(const Shape& shape, const FramePixels& frame, const std::string& valueUnit);

/// Returns the shape of a frame in the space of the slice that shows it: patient mm. If the slice has no
/// place in the patient, mm (px) from its first pixel.
Shape inSliceSpace(Shape ofFrame, const VoxelGeometry& slice);

}  // namespace volumen
