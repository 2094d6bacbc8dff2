#include "ui/workspace/flat_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>

#include "results/series/series_facts.h"

namespace volumen {

namespace {

// Orients a crosshair for a series.
Crosshair lyingFor(const Crosshair& crosshair, const VoxelGeometry& geometry) {
  return crosshair.byHand ? crosshair : alongSlices(crosshair.at, geometry);
}

// Returns the direction of a wheel step down: caudal, posterior or left while unturned.
glm::dvec3 wheelDown(ViewKind kind, const Crosshair& crosshair) {
  return rowOf(kind).plane->wheelSign * crosshair.plane(kind).normal();
}

// The wheel positions along a direction: first + index * step, in mm.
struct Positions {
  glm::dvec3 along{0};
  double first = 0, step = 1;
  int count = 1;
};

Positions positionsOf(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair) {
  const glm::dvec3 down = wheelDown(kind, crosshair);
  Positions stack{.along = down, .step = wheelStep(geometry, down)};
  // From the first to the last voxel: acquired slices if the plane is parallel to them.
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

// Returns the full plane of a view kind while no plane is turned.
SlicePlane unturned(const VoxelGeometry& geometry, ViewKind kind) {
  if (showsFrames(kind)) return framePlane(geometry);
  const PlaneDirections along = alongSlices({}, geometry).plane(kind);
  return planeAlong(geometry, along.right, along.down);
}

// Returns width and height of a full plane in mm, after the look's quarter turns.
glm::dvec2 extent(const SlicePlane& whole, const FlatLook& look) {
  const glm::dvec2 mm = glm::dvec2(whole.size) * whole.mmPerPixel;
  return look.turn.quarters % 2 ? glm::dvec2(mm.y, mm.x) : mm;
}

// Returns a view's crosshair in a frame of reference; null if none is set.
const Crosshair* findCrosshair(const Workspace& workspace, ViewId view, const std::string& frame) {
  const auto find = [&](const SharedMap<std::string, Crosshair>& in) {
    const auto found = in.find(frame);
    return found == in.end() ? nullptr : &found->second;
  };
  const Crosshair* own = scrollsAlone(workspace, view) ? find(workspace.view(view).crosshairs) : nullptr;
  return own ? own : find(workspace.crosshairs);
}

bool liesIn(const VoxelGeometry& geometry, glm::dvec3 pPatient) {
  const glm::dvec3 pVoxel = geometry.voxelFromPatient(pPatient);
  return glm::all(glm::greaterThanEqual(pVoxel, glm::dvec3(-0.5))) &&
         glm::all(glm::lessThan(pVoxel, glm::dvec3(geometry.size) - 0.5));
}

// Without a crosshair, all views of a frame of reference start where the first one does, if that point lies
// in the series. `geometry` is that of the series.
Crosshair startOf(const Workspace& workspace, const Series& series, const VoxelGeometry& geometry) {
  for (ViewId id = 0; id < viewCount; ++id) {
    const Series* first = seriesIn(workspace, id);
    if (!first || !showsSlices(workspace.view(id).kind)) continue;
    if (frameOfReference(*first) != frameOfReference(series)) continue;
    if (keyOf(*first) == keyOf(series)) break;
    const Crosshair start = firstCrosshair(*first);
    if (!liesIn(geometry, start.at)) break;
    return lyingFor(start, geometry);
  }
  return series.regular ? firstCrosshair(series) : firstCrosshair(geometry);
}

}  // namespace

bool scrollsAlone(const Workspace& workspace, ViewId view) {
  return !workspace.links.scroll && view >= firstComparedId;
}

glm::dvec2 wholeMm(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry) {
  return extent(unturned(geometry, view.kind), look);
}

SlicePlane flatPlane(const ViewState& view, const FlatLook& look, const VoxelGeometry& geometry,
                     const Crosshair& crosshair, glm::ivec2 pixels) {
  const bool ofFrames = showsFrames(view.kind);
  SlicePlane plane = unturned(geometry, view.kind);
  const glm::dvec2 whole = extent(plane, look);
  const double fittedMm = std::max(whole.x / pixels.x, whole.y / pixels.y);
  plane.size = pixels;
  plane.mmPerPixel = fittedMm / look.zoom;
  if (!ofFrames) plane.right = crosshair.plane(view.kind).right, plane.down = crosshair.plane(view.kind).down;
  turnAxes(look.turn, plane.right, plane.down);
  plane.centre = geometry.centre() + look.panMm.x * plane.right + look.panMm.y * plane.down;
  if (!ofFrames) plane.centre += plane.normal() * glm::dot(crosshair.at - plane.centre, plane.normal());
  plane.slabMm = look.slabMm;
  plane.slabMode = look.slabMode;
  plane.interpolation = look.nearest ? Interpolation::nearest : Interpolation::linear;
  plane.average = true;
  return plane;
}

StackPlace stackPlace(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair) {
  const Positions stack = positionsOf(geometry, kind, crosshair);
  const double index = std::round((glm::dot(crosshair.at, stack.along) - stack.first) / stack.step);
  return {int(std::clamp(index, 0.0, double(stack.count - 1))), stack.count};
}

glm::dvec3 scrolled(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair, int steps) {
  const Positions stack = positionsOf(geometry, kind, crosshair);
  const int index = std::clamp(stackPlace(geometry, kind, crosshair).index + steps, 0, stack.count - 1);
  const double mm = stack.first + index * stack.step - glm::dot(crosshair.at, stack.along);
  return crosshair.at + stack.along * mm;
}

glm::dvec3 onSlice(const VoxelGeometry& geometry, ViewKind kind, const Crosshair& crosshair) {
  return scrolled(geometry, kind, crosshair, 0);
}

Crosshair firstCrosshair(const VoxelGeometry& geometry) {
  Crosshair crosshair = alongSlices(geometry.centre(), geometry);
  for (const KindRow& row : viewKinds())
    if (row.plane) crosshair.at = onSlice(geometry, row.kind, crosshair);
  return crosshair;
}

Crosshair firstCrosshair(const Series& series) {
  const VoxelGeometry& geometry = drawnGeometry(series);
  Crosshair crosshair = firstCrosshair(geometry);
  if (!series.regular) return crosshair;
  const int middle = int(std::lround(geometry.voxelFromPatient(crosshair.at).z));
  const std::vector<int>& copies = series.regular->copies;
  std::optional<int> nearest;
  for (int k = 0; k < int(copies.size()); ++k)
    if (copies[std::size_t(k)] >= 0 && (!nearest || std::abs(k - middle) < std::abs(*nearest - middle)))
      nearest = k;
  // Moves only along the slice normal, so that it stays on slices of the other planes.
  const glm::dvec3 normal = sliceNormal(geometry);
  const double mm = glm::dot(geometry.patientFromVoxelStep[2], normal);
  if (nearest) crosshair.at += double(*nearest - middle) * mm * normal;
  return crosshair;
}

Crosshair crosshairOf(const Workspace& workspace, const LoadedSeries& series) {
  return crosshairOf(workspace, sceneViewId, series);
}

Crosshair crosshairOf(const Workspace& workspace, ViewId view, const LoadedSeries& series) {
  const Crosshair* known = findCrosshair(workspace, view, frameOfReference(series.series));
  const VoxelGeometry& geometry = series.volume->geometry();
  return known ? lyingFor(*known, geometry) : startOf(workspace, series.series, geometry);
}

Crosshair crosshairOf(const Workspace& workspace, ViewId view, const Series& series) {
  const Crosshair* known = findCrosshair(workspace, view, frameOfReference(series));
  const VoxelGeometry& geometry = drawnGeometry(series);
  return known ? lyingFor(*known, geometry) : startOf(workspace, series, geometry);
}

Workspace withCrosshair(Workspace workspace, ViewId view, const std::string& frame, const Crosshair& before,
                        const Crosshair& after) {
  const bool alone = scrollsAlone(workspace, view);
  auto& crosshairs = alone ? workspace.editView(view).crosshairs : workspace.crosshairs;
  crosshairs.editOrAdd(frame) = after.byHand ? after : Crosshair{after.at};
  Crosshair moved = before;
  moved.at = after.at;
  if (moved == after) return workspace;
  for (ViewId id = 0; id < viewCount; ++id) {
    const ViewState& state = workspace.view(id);
    const Series* series = seriesIn(workspace, id);
    if (!showsSlices(state.kind) || !series || frameOfReference(*series) != frame) continue;
    if (id != view && (alone || (scrollsAlone(workspace, id) && state.crosshairs.contains(frame)))) continue;
    const VoxelGeometry& geometry = drawnGeometry(*series);
    // Offset of the crosshair from the volume's centre in the picture, before and after.
    const FlatLook turned{.turn = flatLookOf(state).turn};
    const auto place = [&](const Crosshair& crosshair) {
      const SlicePlane plane = flatPlane(state, turned, geometry, lyingFor(crosshair, geometry), {1, 1});
      const glm::dvec3 from = after.at - geometry.centre();
      return glm::dvec2(glm::dot(from, plane.right), glm::dot(from, plane.down));
    };
    const glm::dvec2 way = place(after) - place(before);
    ViewState& now = workspace.editView(id);
    now.flats.editOrAdd(now.series).panMm += way;
  }
  return workspace;
}

Crosshair turnedIn(Crosshair crosshair, ViewKind kind, double angle) {
  crosshair.byHand = true;
  const glm::dmat3 rotation(glm::rotate(glm::dmat4(1), angle, crosshair.plane(kind).normal()));
  const PlaneDirections* own = &crosshair.plane(kind);
  for (PlaneDirections* plane : {&crosshair.axial, &crosshair.coronal, &crosshair.sagittal})
    if (plane != own) *plane = {rotation * plane->right, rotation * plane->down};
  return crosshair;
}

Crosshair alongSlices(glm::dvec3 at, const VoxelGeometry& geometry) {
  const glm::dvec3 i = glm::normalize(geometry.patientFromVoxelStep[0]), k = sliceNormal(geometry);
  const glm::dvec3 acquired[] = {i, glm::cross(k, i), k};
  // Takes the smallest of the 24 rotations from the patient's axes to the acquired ones.
  glm::dmat3 best(1);
  double closest = -4;
  int order[] = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      glm::dmat3 axes;
      for (int n = 0; n < 3; ++n) axes[n] = acquired[order[n]] * (signs >> n & 1 ? -1.0 : 1.0);
      const double sum = axes[0].x + axes[1].y + axes[2].z;
      if (glm::determinant(axes) > 0 && sum > closest + 1e-12) closest = sum, best = axes;
    }
  } while (std::next_permutation(std::begin(order), std::end(order)));
  Crosshair crosshair{at};
  for (PlaneDirections* plane : {&crosshair.axial, &crosshair.coronal, &crosshair.sagittal})
    *plane = {best * plane->right, best * plane->down};
  return crosshair;
}

ViewKind acquiredKind(const VoxelGeometry& geometry) {
  const glm::dvec3 normal = sliceNormal(geometry);
  const Crosshair along = alongSlices({}, geometry);
  for (const KindRow& row : viewKinds())
    if (row.plane && std::abs(glm::dot(along.plane(row.kind).normal(), normal)) > 0.5) return row.kind;
  return ViewKind::axial;
}

std::optional<ViewKind> acquiredPlaneOf(const Series& series) {
  if (!series.notVolume.empty() || !series.acquired.calibrated) return {};
  return acquiredKind(series.acquired);
}

std::optional<PixelLine> referenceLine(const SlicePlane& view, const SlicePlane& other) {
  const glm::dvec3 along = glm::cross(view.normal(), other.normal());
  const double sine = glm::length(along);
  if (sine < 1e-6) return {};
  // A point on both planes: from the view's centre within its plane towards the other.
  const glm::dvec3 towards = glm::cross(along / sine, view.normal());
  const double distance =
      glm::dot(other.centre - view.centre, other.normal()) / glm::dot(towards, other.normal());
  const glm::dvec3 p = view.centre + distance * towards;
  const double halfMm = view.mmPerPixel * (view.size.x + view.size.y);
  return PixelLine{view.pixelFromPatient(p - halfMm * along / sine),
                   view.pixelFromPatient(p + halfMm * along / sine)};
}

// Clips as Liang and Barsky do: each edge shortens the part of the line from `low` to `high`.
std::optional<PixelLine> referenceSegment(const SlicePlane& view, const SlicePlane& other) {
  const auto line = referenceLine(view, other);
  if (!line) return {};
  const glm::dvec2 along = line->to - line->from;
  double low = 0, high = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) {
      if (line->from[axis] < 0 || line->from[axis] > view.size[axis]) return {};
      continue;
    }
    const double a = -line->from[axis] / along[axis];
    const double b = (view.size[axis] - line->from[axis]) / along[axis];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  if (low >= high) return {};
  return PixelLine{line->from + low * along, line->from + high * along};
}

SlicePlane carriedTo(const Rigid& toFromFrom, SlicePlane plane) {
  plane.centre = toFromFrom(plane.centre);
  plane.right = toFromFrom.rotation * plane.right;
  plane.down = toFromFrom.rotation * plane.down;
  return plane;
}

}  // namespace volumen
