#pragma once

#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Where a face of a scene's clip box cuts a plane.
struct ClipEdge {
  int axis = 0;  ///< i, j, k: that the face is across
  bool high = false;
  glm::dvec3 from{0}, to{0};  ///< patient mm
};

/// The faces of the box that a plane cuts, in their order.
std::vector<ClipEdge> clipEdges(const Clip& clip, const VoxelGeometry& geometry, const SlicePlane& plane);

/// Moves a face to a fraction of the volume's box along its axis, at most to the box's ends; pushes the
/// opposite face along.
void moveClipFace(Clip& clip, int axis, bool high, double fraction);

}  // namespace volumen
