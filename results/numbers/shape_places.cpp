#include "results/numbers/shape_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "viewer/slice/smooth_curve.h"

namespace volumen {

namespace {

// The box of an ellipse or a rectangle: its middle, and half its sides along and down the plane.
struct Box {
  glm::dvec3 middle, along, down;
};

Box boxOf(const Shape& shape) {
  const glm::dvec3 diagonal = shape.points[1] - shape.points[0];
  const ShapePlane plane = shape.frame ? ShapePlane{} : *shape.plane;
  return {(shape.points[0] + shape.points[1]) / 2.0, plane.right * (glm::dot(diagonal, plane.right) / 2),
          plane.down * (glm::dot(diagonal, plane.down) / 2)};
}

}  // namespace

ShapePlaces::ShapePlaces(const Shape& shape, const MeasuredOn& on) : shape_(shape), on_(on) {
  if (!shape.frame && !on.isTiled) slice_ = sliceOf(shape.points);
}

std::optional<ReportShape> ShapePlaces::onPicture(ReportShape::Type type,
                                                  const std::vector<glm::dvec3>& points) const {
  if (!shape_.frame && !slice_) return {};
  ReportShape out{type, false, {}, {}, {}, {}};
  for (const glm::dvec3& p : points) out.points.push_back(pixelOf(p));
  if (!std::ranges::all_of(out.points, [&](auto p) { return isInside(p); })) return {};
  if (type == ReportShape::Type::polygon)
    out.type = ReportShape::Type::polyline;  // pixels know no polygon; it is closed
  out.pictures.push_back(pictureOf(shape_.frame ? on_.frame : *slice_));
  for (glm::dvec3& p : out.points) p.z = 0;
  return out;
}

Result<ReportShape> ShapePlaces::shapeOf(ReportShape::Type type,
                                         const std::vector<glm::dvec3>& points) const {
  if (auto drawn = onPicture(type, points)) return *std::move(drawn);
  if (shape_.frame) return Error{"it reaches beyond its image"};
  const std::string& space = on_.series->frameOfReferenceUid;
  if (!on_.grid.calibrated || space.empty())
    return Error{"it lies on no slice as acquired, and its series has no frame of reference"};
  return ReportShape{type, true, points, {}, space, {}};
}

std::vector<ReferencedPicture> ShapePlaces::nearest() const {
  std::set<int> slices;
  for (const glm::dvec3& p : shape_.points) slices.insert(nearestSlice(on_.grid.voxelFromPatient(p).z));
  std::vector<ReferencedPicture> pictures;
  std::set<std::string> known;
  for (int n = 0; n < int(on_.series->sopInstanceUids.size()); ++n) {
    const bool isWanted = shape_.points.empty() || slices.contains(n);
    if (!isWanted || ((shape_.points.empty() || on_.isTiled) &&
                      !known.insert(on_.series->sopInstanceUids[std::size_t(n)]).second))
      continue;
    pictures.push_back(pictureOf(n));
    if (shape_.points.empty() || on_.isTiled) pictures.back().frames.clear();
  }
  return pictures;
}

std::size_t ShapePlaces::sliceCount() const {
  return on_.places.empty() ? std::size_t(on_.grid.size.z) : on_.places.size();
}

double ShapePlaces::placeOf(std::size_t slice) const {
  return on_.places.empty() ? double(slice) : on_.places[slice];
}

int ShapePlaces::nearestSlice(double k) const {
  std::size_t best = 0;
  for (std::size_t n = 1; n < sliceCount(); ++n)
    if (std::abs(placeOf(n) - k) < std::abs(placeOf(best) - k)) best = n;
  return int(best);
}

// Returns the acquired slice that all points lie on: the one that a slice of the grid is, or one between
// them.
std::optional<int> ShapePlaces::sliceOf(const std::vector<glm::dvec3>& points) const {
  if (points.empty()) return {};
  const double k = on_.grid.voxelFromPatient(points[0]).z, drawn = std::round(k);
  const bool isInGrid = drawn >= 0 && drawn < double(on_.origins.size());
  if (isInGrid && areOn(points, drawn))
    if (const SliceOrigin& origin = on_.origins[std::size_t(drawn)]; !origin.isInterpolated())
      return origin.below;
  const int slice = nearestSlice(k);
  if (!areOn(points, placeOf(std::size_t(slice)))) return {};
  return slice;
}

bool ShapePlaces::areOn(const std::vector<glm::dvec3>& points, double k) const {
  constexpr double offMm = 0.01;
  const glm::dmat3& step = on_.grid.patientFromVoxelStep;
  const double sliceMm = std::abs(glm::dot(step[2], glm::normalize(glm::cross(step[0], step[1]))));
  return std::ranges::all_of(
      points, [&](glm::dvec3 p) { return std::abs(on_.grid.voxelFromPatient(p).z - k) * sliceMm <= offMm; });
}

// The centre of the first pixel is at 0.5, 0.5 (PS3.3 C.18.6.1, C.10.5.1.2).
glm::dvec3 ShapePlaces::pixelOf(glm::dvec3 p) const {
  return (shape_.frame ? p : on_.grid.voxelFromPatient(p)) + glm::dvec3(0.5, 0.5, 0);
}

bool ShapePlaces::isInside(glm::dvec3 pixel) const {
  const glm::ivec3 size = on_.series->acquired.size;
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= size.x && pixel.y <= size.y;
}

ReferencedPicture ShapePlaces::pictureOf(int slice) const {
  const auto n = std::size_t(slice);
  return {on_.series->sopInstanceUids[n], {}, {on_.series->frames[n]}, {}};
}

std::vector<glm::dvec3> axisEnds(const Shape& ellipse, const glm::dvec3& mm) {
  Box box = boxOf(ellipse);
  if (glm::length(box.along * mm) < glm::length(box.down * mm)) std::swap(box.along, box.down);
  return {box.middle - box.along, box.middle + box.along, box.middle - box.down, box.middle + box.down};
}

std::vector<glm::dvec3> cornersOf(const Shape& rectangle) {
  const Box box = boxOf(rectangle);
  const glm::dvec3 first = box.middle - box.along - box.down;
  return {first, first + 2.0 * box.along, box.middle + box.along + box.down, first + 2.0 * box.down, first};
}

std::vector<glm::dvec3> lineOf(const Shape& shape, const glm::dvec3& mm) {
  constexpr int partsAPiece = 8;
  std::vector<glm::dvec3> points = shape.points;
  if (shape.kind != ShapeKind::openCurve) return points;
  for (glm::dvec3& p : points) p *= mm;
  const Result<SmoothCurve> curve = SmoothCurve::through(points);
  if (!curve) return shape.points;
  points = curve->line(partsAPiece);
  for (glm::dvec3& p : points) p /= mm;
  return points;
}

std::vector<glm::dvec3> closed(std::vector<glm::dvec3> points) {
  points.push_back(points.front());
  return points;
}

}  // namespace volumen
