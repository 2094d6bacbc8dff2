#pragma once

#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// The line in which a face of a scene's clip box cuts a plane.
struct ClipEdge {
  int axis = 0;  ///< axis (i, j, k) perpendicular to the face
  bool high = false;
  glm::dvec3 from{0}, to{0};  ///< patient mm
};

/// Returns the lines in which `plane` cuts faces of the clip box, in the order of the faces.
std::vector<ClipEdge> clipEdges(const Clip& clip, const VoxelGeometry& geometry, const SlicePlane& plane);

/// Moves a face to a fraction (clamped to 0 to 1) of the volume's box along its axis. Pushes the opposite
/// face along.
void moveClipFace(Clip& clip, int axis, bool high, double fraction);

}  // namespace volumen
