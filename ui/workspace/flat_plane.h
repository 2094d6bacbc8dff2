#pragma once

#include <optional>

#include "ui/data/shown_frame.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// The plane that a flat view shows, through the cursor, or of frames, whose slice is the volume; as many
/// pixels as asked for. `view`: not a 3D one.
SlicePlane flatPlane(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry,
                     glm::dvec3 cursor, glm::ivec2 pixels);

/// The point moved along the normal of a kind of view to the nearest place where wheel steps land: on an
/// acquired slice where the plane is parallel to them.
glm::dvec3 onSlice(const VoxelGeometry& geometry, ViewKind kind, glm::dvec3 p);

/// Where the cursor starts: in the middle, on slices of all three planes.
glm::dvec3 firstCursor(const VoxelGeometry& geometry);

/// The cursor of the series' frame of reference; where none was set yet, firstCursor().
glm::dvec3 cursorOf(const Workspace& workspace, const ShownSeries& series);

/// The point after so many steps of the wheel (down: caudal, posterior, left of the patient), kept inside the
/// volume.
glm::dvec3 scrolled(const VoxelGeometry& geometry, ViewKind kind, glm::dvec3 p, int steps);

/// Which step along a view's normal a point is on, and of how many; from 0 at the first end.
struct StackPlace {
  int index = 0, count = 1;
};
StackPlace stackPlace(const VoxelGeometry& geometry, ViewKind kind, glm::dvec3 p);

/// The ends of the line in which the plane of `view` cuts `other`, in pixels of `view`; none where they are
/// parallel.
struct PixelLine {
  glm::dvec2 from, to;
};
std::optional<PixelLine> referenceLine(const SlicePlane& view, const SlicePlane& other);

}  // namespace volumen
