#include "results/numbers/report_of_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "results/numbers/report_codes.h"
#include "viewer/slice/smooth_curve.h"

namespace volumen {

namespace {

using Points = std::vector<glm::dvec3>;
using Type = ReportShape::Type;

// Returns the quantity that the values of a probe are of (TID 1419, CID 7180).
Code quantityOf(const std::string& unit) {
  if (unit == "HU") return {"112031", "DCM", "Attenuation Coefficient"};
  if (unit == "SUVbw") return {"126401", "DCM", "SUVbw"};
  if (unit == "SUVlbm") return {"126402", "DCM", "SUVlbm"};
  if (unit == "SUVbsa") return {"126403", "DCM", "SUVbsa"};
  return meanCode;
}

// The tool that Cornerstone3D draws a kind of shape with; null if it has none.
const char* toolOf(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::length:
      return "Length";
    case ShapeKind::polyline:
    case ShapeKind::openCurve:
    case ShapeKind::freehand:
      return "PlanarFreehandROI";
    case ShapeKind::angle:
    case ShapeKind::legAxis:
      return "Angle";
    case ShapeKind::cobb:
      return "CobbAngle";
    case ShapeKind::bidirectional:
      return "Bidirectional";
    case ShapeKind::ellipse:
      return "EllipticalROI";
    case ShapeKind::rectangle:
      return "RectangleROI";
    case ShapeKind::probe:
      return "Probe";
    default:
      return nullptr;
  }
}

std::string trackingIdOf(const Shape& shape) {
  const char* tool = toolOf(shape.kind);
  const std::string id = tool ? std::string("Cornerstone3DTools@^0.1.0:") + tool
                              : std::string("volumen:") + ruleOf(shape.kind).name;
  return shape.name.empty() ? id : id + ":" + shape.name;
}

/// Brings points of a shape to the images of a report.
class ReportPlaces {
 public:
  ReportPlaces(const Shape& shape, const ReportedOn& on) : shape_(shape), on_(on) {
    if (!shape.frame && !on.isTiled) slice_ = sliceOf(shape.points);
  }

  // Returns the shape with these points, in the shape's own space.
  Result<ReportShape> shapeOf(Type type, const Points& points) const {
    ReportShape out{type, false, {}, {}, {}, {}};
    for (const glm::dvec3& p : points) out.points.push_back(pixelOf(p));
    if (shape_.frame && !std::ranges::all_of(out.points, [&](auto p) { return isInside(p); }))
      return Error{"it reaches beyond its image"};
    const bool isFlat =
        shape_.frame || (slice_ && std::ranges::all_of(out.points, [&](auto p) { return isInside(p); }));
    if (!isFlat) return inPatient(type, points);
    if (type == Type::polygon) out.type = Type::polyline;  // pixels know no polygon; it is closed
    out.pictures.push_back(pictureOf(shape_.frame ? on_.frame : *slice_));
    for (glm::dvec3& p : out.points) p.z = 0;
    return out;
  }

  // Returns the images next to the points of the shape, for shapes in patient space; all without points.
  std::vector<ReferencedPicture> nearest() const {
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

 private:
  std::size_t sliceCount() const {
    return on_.places.empty() ? std::size_t(on_.grid.size.z) : on_.places.size();
  }
  double placeOf(std::size_t slice) const { return on_.places.empty() ? double(slice) : on_.places[slice]; }

  int nearestSlice(double k) const {
    std::size_t best = 0;
    for (std::size_t n = 1; n < sliceCount(); ++n)
      if (std::abs(placeOf(n) - k) < std::abs(placeOf(best) - k)) best = n;
    return int(best);
  }

  // Returns the acquired slice that all points lie on: the one that a slice of the grid is, or one between
  // them.
  std::optional<int> sliceOf(const Points& points) const {
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

  bool areOn(const Points& points, double k) const {
    constexpr double offMm = 0.01;
    const glm::dmat3& step = on_.grid.patientFromVoxelStep;
    const double sliceMm = std::abs(glm::dot(step[2], glm::normalize(glm::cross(step[0], step[1]))));
    return std::ranges::all_of(points, [&](glm::dvec3 p) {
      return std::abs(on_.grid.voxelFromPatient(p).z - k) * sliceMm <= offMm;
    });
  }

  // The centre of the first pixel is at 0.5, 0.5 (PS3.3 C.18.6.1).
  glm::dvec3 pixelOf(glm::dvec3 p) const {
    return (shape_.frame ? p : on_.grid.voxelFromPatient(p)) + glm::dvec3(0.5, 0.5, 0);
  }

  bool isInside(glm::dvec3 pixel) const {
    const glm::ivec3 size = on_.series->acquired.size;
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= size.x && pixel.y <= size.y;
  }

  ReferencedPicture pictureOf(int slice) const {
    const auto n = std::size_t(slice);
    return {on_.series->sopInstanceUids[n], {}, {on_.series->frames[n]}, {}};
  }

  Result<ReportShape> inPatient(Type type, const Points& points) const {
    const std::string& space = on_.series->frameOfReferenceUid;
    if (!on_.grid.calibrated || space.empty())
      return Error{"it lies on no slice as acquired, and its series has no frame of reference"};
    return ReportShape{type, true, points, {}, space, {}};
  }

  const Shape& shape_;
  const ReportedOn& on_;
  std::optional<int> slice_;
};

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

// Returns the ends of the long axis, then of the short one.
Points ellipseEnds(const Shape& shape, const glm::dvec3& mm) {
  Box box = boxOf(shape);
  if (glm::length(box.along * mm) < glm::length(box.down * mm)) std::swap(box.along, box.down);
  return {box.middle - box.along, box.middle + box.along, box.middle - box.down, box.middle + box.down};
}

Points rectangleCorners(const Shape& shape) {
  const Box box = boxOf(shape);
  const glm::dvec3 first = box.middle - box.along - box.down;
  return {first, first + 2.0 * box.along, box.middle + box.along + box.down, first + 2.0 * box.down, first};
}

Points closed(Points points) {
  points.push_back(points.front());
  return points;
}

// Returns the points that stand for a line: those of a curve are close together.
Points lineOf(const Shape& shape, const glm::dvec3& mm) {
  constexpr int partsAPiece = 8;
  Points points = shape.points;
  if (shape.kind != ShapeKind::openCurve) return points;
  for (glm::dvec3& p : points) p *= mm;
  const Result<SmoothCurve> curve = SmoothCurve::through(points);
  if (!curve) return shape.points;
  points = curve->line(partsAPiece);
  for (glm::dvec3& p : points) p /= mm;
  return points;
}

/// Builds the group of one shape.
class ShapeReporter {
 public:
  ShapeReporter(const Shape& shape, const Measured& measured, const ReportedOn& on)
      : shape_(shape),
        measured_(measured),
        places_(shape, on),
        mm_(shape.frame ? glm::dvec3(on.pixelMm, 1) : glm::dvec3(1)) {}

  Result<MeasurementGroup> run() {
    group_.trackingId = trackingIdOf(shape_);
    if (!shape_.name.empty()) group_.finding = {"label", "99VOLUMEN", shape_.name};
    addNumbers();
    if (problem_) return *problem_;
    const bool isInPatient = std::ranges::any_of(group_.measurements, [](const ReportMeasurement& m) {
      return std::ranges::any_of(m.shapes, &ReportShape::inPatient);
    });
    if (isInPatient || shape_.points.empty()) group_.pictures = places_.nearest();
    return std::move(group_);
  }

 private:
  void addNumbers() {
    const Points& p = shape_.points;
    switch (shape_.kind) {
      case ShapeKind::length:
      case ShapeKind::polyline:
      case ShapeKind::openCurve:
        return add(lengthCode, measured_.number, millimetre, {draw(Type::polyline, lineOf(shape_, mm_))});
      case ShapeKind::angle:
        return add(angleCode, measured_.number, degree, {draw(Type::polyline, {p[0], p[1], p[1], p[2]})});
      case ShapeKind::legAxis:
        return add(angleCode, measured_.leg->hka, degree, {draw(Type::polyline, {p[0], p[1], p[1], p[2]})});
      case ShapeKind::cobb:
        return add(angleCode, measured_.number, degree, {draw(Type::polyline, p)});
      case ShapeKind::bidirectional:
        return addAxes();
      case ShapeKind::cardiothoracic:
        return add(ratioCode, measured_.number, ratio,
                   {draw(Type::polyline, {p[0], p[1]}), draw(Type::polyline, {p[2], p[3]})});
      case ShapeKind::ellipse:
        return addRegion(draw(Type::ellipse, ellipseEnds(shape_, mm_)));
      case ShapeKind::rectangle:
        return addRegion(draw(Type::polygon, rectangleCorners(shape_)));
      case ShapeKind::freehand:
        return addRegion(draw(Type::polygon, closed(p)));
      case ShapeKind::probe:
        return add(quantityOf(measured_.valueUnit), measured_.number, unitOfValues(measured_.valueUnit),
                   {draw(Type::point, p)});
      default:
        return add(volumeCode, measured_.number, millilitre, {});
    }
  }

  ReportShape draw(Type type, const Points& points) {
    Result<ReportShape> drawn = places_.shapeOf(type, points);
    if (drawn) return *drawn;
    problem_ = drawn.error();
    return {};
  }

  void add(const Code& name, double value, const Code& unit, std::vector<ReportShape> shapes) {
    group_.measurements.push_back({name, unit, value, {}, std::move(shapes)});
  }

  // The axis drawn first is not always the longer one.
  void addAxes() {
    Points p = shape_.points;
    if (glm::distance(p[0] * mm_, p[1] * mm_) < glm::distance(p[2] * mm_, p[3] * mm_))
      std::swap(p[0], p[2]), std::swap(p[1], p[3]);
    add(longAxisCode, measured_.lines->first, millimetre, {draw(Type::polyline, {p[0], p[1]})});
    add(shortAxisCode, measured_.lines->second, millimetre, {draw(Type::polyline, {p[2], p[3]})});
  }

  void addRegion(const ReportShape& region) {
    group_.shapes.push_back(region);
    add(areaCode, measured_.number, squareMillimetre, {region});
    const Code unit = unitOfValues(measured_.valueUnit);
    if (const auto& values = measured_.values)
      for (const ReportMeasurement& one :
           reportedValues(values->mean, values->sd, values->min, values->max, unit))
        group_.measurements.push_back(one);
    if (measured_.peak) add(peakCode, measured_.peak->mean, unit, {});
  }

  const Shape& shape_;
  const Measured& measured_;
  const ReportPlaces places_;
  const glm::dvec3 mm_;
  MeasurementGroup group_;
  std::optional<Error> problem_;
};

}  // namespace

Result<MeasurementGroup> reportedShape(const Shape& shape, const Measured& measured, const ReportedOn& on) {
  const std::string& unit = measured.lines && !measured.unit.empty() ? measured.lines->unit : measured.unit;
  if (unit == "px" || unit == "px^2" || unit == "voxels")
    return Error{"it is in pixels, as its images are not calibrated, and a report needs mm"};
  if (measured.frame && measured.frame->rgb) return Error{"the values of a colour image are no measurement"};
  if (on.series->format != "DICOM" || on.series->curved)
    return Error{"its series comes from no DICOM files, whose images a report must name"};
  return ShapeReporter(shape, measured, on).run();
}

}  // namespace volumen
