#pragma once

#include <optional>

#include "ui/data/loaded_frame.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// The plane that a flat view shows, through the crosshair and turned as it is, or of frames, whose slice is
/// the volume; as many pixels as asked for. `view`: not a 3D one. Turning changes no size: a view fits what
/// it would show unturned.
SlicePlane flatPlane(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry,
                     const Crosshair& crosshair, glm::ivec2 pixels);

/// How large all of what a flat view shows is, mm across and down, turned as it is.
glm::dvec2 wholeMm(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry);

/// The crosshair's point moved along the normal of a kind of view to the nearest place where wheel steps
/// land: on an acquired slice where the plane is parallel to them.
glm::dvec3 onSlice(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair);

/// Where it starts: in the middle, on slices of all three planes, which lie along the slices as acquired.
Crosshair firstCrosshair(const VoxelGeometry& geometry);
/// The same on the grid that is drawn of a series, of whose slices it is on one as acquired.
Crosshair firstCrosshair(const Series& series);

/// Whether a view has positions of its own: it is one of those to compare, and they are not linked.
bool scrollsAlone(const Workspace& workspace, ViewId view);

/// The grid of a series that is drawn.
const VoxelGeometry& drawnGeometry(const Series& series);

/// The crosshair of the series' frame of reference, as it lies for this series; where none was set yet,
/// firstCrosshair() of what the first view of the frame shows, or its own where it does not reach there.
Crosshair crosshairOf(const Workspace& workspace, const LoadedSeries& series);
/// The same in a view, which may scroll alone.
Crosshair crosshairOf(const Workspace& workspace, ViewId view, const LoadedSeries& series);
Crosshair crosshairOf(const Workspace& workspace, ViewId view, const Series& series);

/// Its point after so many steps of the wheel (unturned down: caudal, posterior, left of the patient), kept
/// inside the volume.
glm::dvec3 scrolled(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair, int steps);

/// Which step along a view's normal the crosshair is on, and of how many; from 0 at the first end.
struct StackPlace {
  int index = 0, count = 1;
};
StackPlace stackPlace(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair);

/// A place of a stack, and the number that it has on screen: of slices and frames as acquired that in the
/// series.
struct NumberedPlace {
  int number = 1, place = 0;
};

/// With a flat view at another place of its stack: a step of the wheel, or a frame; from 0. `shown`: what the
/// view shows.
Workspace withPlace(Workspace workspace, ViewId view, const LoadedSeries& shown, int index);

/// With another crosshair for a frame of reference, or for the view alone where it scrolls alone. Where it is
/// turned otherwise than before, every view that it belongs to keeps its point at the same place of the
/// picture.
Workspace withCrosshair(Workspace workspace, ViewId view, const std::string& frame, const Crosshair& before,
                        const Crosshair& after);

/// The kind of plane that lies along the slices as acquired where no plane was turned by hand.
ViewKind acquiredKind(const VoxelGeometry& geometry);

/// With the planes of the two other kinds turned about the normal of this one, radians, clockwise in its
/// picture where that is not mirrored.
Crosshair turnedIn(Crosshair crosshair, ViewKind kind, double angle);

/// Planes along the slices as acquired and at right angles to them, each named after the patient's plane that
/// it is closest to.
Crosshair alongSlices(glm::dvec3 at, const VoxelGeometry& geometry);

/// The ends of the line in which the plane of `view` cuts `other`, in pixels of `view`; none where they are
/// parallel.
struct PixelLine {
  glm::dvec2 from, to;
};
std::optional<PixelLine> referenceLine(const SlicePlane& view, const SlicePlane& other);
/// The part of it that lies in the picture of `view`; none where it lies beside it.
std::optional<PixelLine> referenceSegment(const SlicePlane& view, const SlicePlane& other);
/// A plane as it lies in another frame of reference.
SlicePlane carriedTo(const Rigid& toFromFrom, SlicePlane plane);

}  // namespace volumen
