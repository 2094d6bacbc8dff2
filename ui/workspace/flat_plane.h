#pragma once

#include <optional>

#include "results/series/loaded_frame.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// Returns the plane of a flat view in `pixels`: through the crosshair and turned like it, or the frame
/// itself for views of frames. `view` is not a 3D view. Turned planes keep their scale: a view is fitted to
/// its unturned extent.
SlicePlane flatPlane(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry,
                     const Crosshair& crosshair, glm::ivec2 pixels);

/// Returns the full extent of a flat view, mm across and down, as rotated by the look.
glm::dvec2 wholeMm(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry);

/// Returns the crosshair's point moved along the normal of a view kind to the nearest wheel position. That is
/// an acquired slice if the plane is parallel to the slices.
glm::dvec3 onSlice(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair);

/// Returns the initial crosshair: at the centre, on slices of all three planes, parallel to the acquired
/// slices.
Crosshair firstCrosshair(const VoxelGeometry& geometry);
/// Returns the same on the drawn grid of a series, on one of its acquired slices.
Crosshair firstCrosshair(const Series& series);

/// Returns whether a view has its own positions: it is a comparison view and positions are not linked.
bool scrollsAlone(const Workspace& workspace, ViewId view);

/// Returns the crosshair of the series' frame of reference, oriented for this series. If none is set:
/// firstCrosshair() of the first view in that frame of reference, or of this series if that point lies
/// outside it.
Crosshair crosshairOf(const Workspace& workspace, const LoadedSeries& series);
/// Returns the same for a view, which may scroll alone.
Crosshair crosshairOf(const Workspace& workspace, ViewId view, const LoadedSeries& series);
Crosshair crosshairOf(const Workspace& workspace, ViewId view, const Series& series);

/// Returns the crosshair's point after `steps` wheel steps, kept inside the volume. In unturned planes, down
/// is caudal, posterior or left.
glm::dvec3 scrolled(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair, int steps);

/// The index (from 0 at the first end) of the crosshair's position along a view's normal, and the number of
/// positions.
struct StackPlace {
  int index = 0, count = 1;
};
StackPlace stackPlace(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair);

/// Sets the crosshair of a frame of reference, or of the view alone if it scrolls alone. If its planes turn,
/// every view of it keeps its point at the same position in the picture.
Workspace withCrosshair(Workspace workspace, ViewId view, const std::string& frame, const Crosshair& before,
                        const Crosshair& after);

/// Returns the kind of plane parallel to the acquired slices while no plane is turned by hand.
ViewKind acquiredKind(const VoxelGeometry& geometry);
/// Returns the patient plane closest to the slices; empty if not calibrated or no volume.
std::optional<ViewKind> acquiredPlaneOf(const Series& series);

/// Turns the planes of the two other kinds about this one's normal, in radians, clockwise in its unmirrored
/// picture.
Crosshair turnedIn(Crosshair crosshair, ViewKind kind, double angle);

/// Returns planes parallel and perpendicular to the acquired slices, each named after the closest patient
/// plane.
Crosshair alongSlices(glm::dvec3 at, const VoxelGeometry& geometry);

/// The ends of a line, in pixels of a view.
struct PixelLine {
  glm::dvec2 from, to;
};
/// Returns the line in which `other` cuts the plane of `view`, in pixels of `view`; empty if they are
/// parallel.
std::optional<PixelLine> referenceLine(const SlicePlane& view, const SlicePlane& other);
/// Returns its part inside the picture of `view`; empty if it lies outside.
std::optional<PixelLine> referenceSegment(const SlicePlane& view, const SlicePlane& other);
/// Returns a plane transformed to another frame of reference.
SlicePlane carriedTo(const Rigid& toFromFrom, SlicePlane plane);

}  // namespace volumen
