#include "results/numbers/report_of_shapes.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "results/numbers/report_codes.h"
#include "results/text/text.h"

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

std::string trackingIdOf(ShapeKind kind, const std::string& name) {
  const char* tool = toolOf(kind);
  const std::string id =
      tool ? std::string("Cornerstone3DTools@^0.1.0:") + tool : std::string("volumen:") + ruleOf(kind).name;
  return name.empty() ? id : id + ":" + name;
}

/// Builds the group of one shape.
class ShapeReporter {
 public:
  ShapeReporter(const Shape& shape, const Measured& measured, const MeasuredOn& on)
      : shape_(shape),
        measured_(measured),
        places_(shape, on),
        mm_(shape.frame ? glm::dvec3(on.pixelMm, 1) : glm::dvec3(1)) {}

  Result<MeasurementGroup> run() {
    const std::string name = shownText(shape_.name).toStdString();
    group_.trackingId = trackingIdOf(shape_.kind, name);
    if (!name.empty()) group_.finding = {"label", "99VOLUMEN", name};
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
        return addRegion(draw(Type::ellipse, axisEnds(shape_, mm_)));
      case ShapeKind::rectangle:
        return addRegion(draw(Type::polygon, cornersOf(shape_)));
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
  const ShapePlaces places_;
  const glm::dvec3 mm_;
  MeasurementGroup group_;
  std::optional<Error> problem_;
};

}  // namespace

Result<MeasurementGroup> reportedShape(const Shape& shape, const Measured& measured, const MeasuredOn& on) {
  const std::string& unit = measured.lines && !measured.unit.empty() ? measured.lines->unit : measured.unit;
  if (unit == "px" || unit == "px^2" || unit == "voxels")
    return Error{"it is in pixels, as its images are not calibrated, and a report needs mm"};
  if (measured.frame && measured.frame->rgb) return Error{"the values of a colour image are no measurement"};
  if (on.series->format != "DICOM" || on.series->curved)
    return Error{"its series comes from no DICOM files, whose images a report must name"};
  return ShapeReporter(shape, measured, on).run();
}

}  // namespace volumen
