#include "ui/workspace/flat_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

NamedPlane namedPlaneOf(ViewKind kind) {
  return kind == ViewKind::coronal    ? NamedPlane::coronal
         : kind == ViewKind::sagittal ? NamedPlane::sagittal
                                      : NamedPlane::axial;
}

// The patient axis that the wheel moves along, downwards: caudal, posterior, left.
glm::dvec3 wheelDown(ViewKind kind) {
  return kind == ViewKind::coronal    ? glm::dvec3(0, 1, 0)
         : kind == ViewKind::sagittal ? glm::dvec3(1, 0, 0)
                                      : glm::dvec3(0, 0, -1);
}

// The places along a direction where slices lie: first + index * step, in mm along it.
struct Stack {
  glm::dvec3 along{0};
  double first = 0, step = 1;
  int count = 1;
};

Stack stackOf(const VoxelGeometry& geometry, ViewKind kind) {
  Stack stack{.along = wheelDown(kind), .step = wheelStep(geometry, wheelDown(kind))};
  // Through the first and the last voxel: acquired slices, where the plane is parallel to them.
  double low = 1e300, high = -1e300;
  const glm::ivec3 last = geometry.size - 1;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 pVoxel(corner & 1 ? last.x : 0, corner & 2 ? last.y : 0, corner & 4 ? last.z : 0);
    const double at = glm::dot(geometry.patientFromVoxel(pVoxel), stack.along);
    low = std::min(low, at), high = std::max(high, at);
  }
  stack.first = low;
  stack.count = 1 + int(std::floor((high - low) / stack.step + 1e-6));
  return stack;
}

}  // namespace

SlicePlane flatPlane(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry,
                     glm::dvec3 cursor, glm::ivec2 pixels) {
  SlicePlane plane =
      view.kind == ViewKind::frames ? framePlane(geometry) : namedPlane(geometry, namedPlaneOf(view.kind));
  const glm::dvec2 whole = glm::dvec2(plane.size) * plane.mmPerPixel;
  const double fittedMm = std::max(whole.x / pixels.x, whole.y / pixels.y);
  plane.size = pixels;
  plane.mmPerPixel = fittedMm / look.zoom;
  plane.centre = geometry.centre() + look.panMm.x * plane.right + look.panMm.y * plane.down;
  plane.centre += plane.normal() * glm::dot(cursor - plane.centre, plane.normal());
  plane.slabMm = look.slabMm;
  plane.slabMode = look.slabMode;
  plane.interpolation = look.nearest ? Interpolation::nearest : Interpolation::linear;
  plane.average = true;
  return plane;
}

StackPlace stackPlace(const VoxelGeometry& geometry, ViewKind kind, glm::dvec3 p) {
  const Stack stack = stackOf(geometry, kind);
  const double index = std::round((glm::dot(p, stack.along) - stack.first) / stack.step);
  return {int(std::clamp(index, 0.0, double(stack.count - 1))), stack.count};
}

glm::dvec3 scrolled(const VoxelGeometry& geometry, ViewKind kind, glm::dvec3 p, int steps) {
  const Stack stack = stackOf(geometry, kind);
  const int index = std::clamp(stackPlace(geometry, kind, p).index + steps, 0, stack.count - 1);
  return p + stack.along * (stack.first + index * stack.step - glm::dot(p, stack.along));
}

glm::dvec3 onSlice(const VoxelGeometry& geometry, ViewKind kind, glm::dvec3 p) {
  return scrolled(geometry, kind, p, 0);
}

glm::dvec3 firstCursor(const VoxelGeometry& geometry) {
  glm::dvec3 cursor = geometry.centre();
  for (const ViewKind kind : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal})
    cursor = onSlice(geometry, kind, cursor);
  return cursor;
}

glm::dvec3 cursorOf(const Workspace& workspace, const ShownSeries& series) {
  const auto cursor = workspace.cursors.find(frameOfReference(series.series));
  return cursor == workspace.cursors.end() ? firstCursor(series.volume->geometry()) : cursor->second;
}

std::optional<PixelLine> referenceLine(const SlicePlane& view, const SlicePlane& other) {
  const glm::dvec3 along = glm::cross(view.normal(), other.normal());
  const double sine = glm::length(along);
  if (sine < 1e-6) return {};
  // A point of both planes: from the view's centre, within it, towards the other.
  const glm::dvec3 towards = glm::cross(along / sine, view.normal());
  const double distance =
      glm::dot(other.centre - view.centre, other.normal()) / glm::dot(towards, other.normal());
  const glm::dvec3 p = view.centre + distance * towards;
  const double halfMm = view.mmPerPixel * (view.size.x + view.size.y);
  return PixelLine{view.pixelFromPatient(p - halfMm * along / sine),
                   view.pixelFromPatient(p + halfMm * along / sine)};
}

}  // namespace volumen
