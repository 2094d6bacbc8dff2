#pragma once

#include "ui/data/loaded_frame.h"
#include "ui/workspace/hanging_protocol.h"

namespace volumen {

/// On which side of a mammogram, as acquired, the chest wall is: by the file's PatientOrientation, else the
/// side that is brighter; `anywhere` where neither tells.
ChestWall chestWallOf(const LoadedFrame& frame);

/// Whether a mammogram, as acquired, has below what is shown above: the head, or of a breast seen from above
/// (CC) its outer side. By the file's PatientOrientation; false where it says neither.
bool liesUpsideDown(const LoadedFrame& frame);

/// A frame in its view, and where its chest wall is wanted.
struct FacingFrame {
  LoadedFramePtr frame;
  FlatLook look;
  glm::ivec2 pixels{1};  ///< of the view
  ChestWall wanted = ChestWall::anywhere;
};

/// The looks by which frames face each other: upright, turned by half or mirrored where their chest wall is
/// on the other side than wanted, moved to that edge of the view, and, `sameScale`, as many mm a pixel as the
/// one that needs most; those whose pixels have no size in mm fill their views.
std::vector<FlatLook> facingLooks(const std::vector<FacingFrame>& frames, bool sameScale);

}  // namespace volumen
