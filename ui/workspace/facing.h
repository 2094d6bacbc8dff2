#pragma once

#include "results/series/loaded_frame.h"
#include "ui/workspace/hanging_protocol.h"

namespace volumen {

/// Returns the side of the chest wall in a mammogram as acquired: by PatientOrientation, else the brighter
/// side. `anywhere` if neither decides.
ChestWall chestWallOf(const LoadedFrame& frame);

/// Returns whether a mammogram as acquired lies upside down by PatientOrientation: the head is down, or in a
/// CC view (from above) the outer side. False if the orientation says neither.
bool liesUpsideDown(const LoadedFrame& frame);

/// A frame in its view, and the wanted side of its chest wall.
struct FacingFrame {
  LoadedFramePtr frame;
  FlatLook look;
  glm::ivec2 pixels{1};  ///< size of the view
  ChestWall wanted = ChestWall::anywhere;
};

/// Returns looks by which frames face each other. Frames are upright and moved to the wanted edge of the
/// view, rotated by 180 degrees or mirrored if necessary. With `sameScale` all have the mm per pixel of the
/// frame that needs most. Frames without pixel size in mm fill their views.
std::vector<FlatLook> facingLooks(const std::vector<FacingFrame>& frames, bool sameScale);

}  // namespace volumen
