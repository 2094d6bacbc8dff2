#include "io/export/report_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/export/dicom_modules.h"

namespace volumen {

namespace {

// A type of shape, the number of its points, and whether it exists in pixels and in the patient (PS3.3
// C.18.6.1.2, C.18.9.1.2).
struct GraphicRule {
  std::size_t fewest, most;
  bool inPixels, inPatient;
};

GraphicRule graphicRuleOf(ReportShape::Type type) {
  constexpr std::size_t any = SIZE_MAX;
  constexpr GraphicRule rules[] = {{1, 1, true, true},    {1, any, true, true}, {2, any, true, true},
                                   {3, any, false, true}, {2, 2, true, false},  {4, 4, true, true},
                                   {6, 6, false, true}};
  return rules[int(type)];
}

bool isFinite(glm::dvec3 p) {
  const auto isFloat = [](double x) { return std::abs(x) <= double(std::numeric_limits<float>::max()); };
  return isFloat(p.x) && isFloat(p.y) && isFloat(p.z);
}

Status checkPictures(const std::vector<ReferencedPicture>& pictures, const DocumentSource& source) {
  for (const ReferencedPicture& picture : pictures)
    if (Status s = checkPicture(picture, source); !s) return s;
  return {};
}

Status checkReportShape(const ReportShape& shape, const DocumentSource& source) {
  const std::string name = std::string("its ") + typeName(shape.type);
  const GraphicRule rule = graphicRuleOf(shape.type);
  if (!(shape.inPatient ? rule.inPatient : rule.inPixels))
    return Error{name + " does not exist in " + (shape.inPatient ? "patient space" : "pixels of an image")};
  if (shape.points.size() < rule.fewest || shape.points.size() > rule.most)
    return Error{name + " has the wrong number of points"};
  if (!std::ranges::all_of(shape.points, isFinite)) return Error{name + " has points that are not finite"};
  if (shape.inPatient && shape.frameOfReferenceUid.empty())
    return Error{name + " is in patient space, but has no frame of reference"};
  if (!shape.inPatient && shape.pictures.empty()) return Error{name + " names no image"};
  return checkPictures(shape.pictures, source);
}

Status checkShapes(const std::vector<ReportShape>& shapes, const DocumentSource& source) {
  for (const ReportShape& shape : shapes)
    if (Status s = checkReportShape(shape, source); !s) return s;
  return {};
}

Status checkProperties(const std::vector<ReportProperty>& properties) {
  for (const ReportProperty& property : properties)
    if (!isWhole(property.name) || !isWhole(property.value))
      return Error{"one of its properties has no code"};
  return {};
}

Status checkMeasurement(const ReportMeasurement& measurement, const DocumentSource& source) {
  if (!isWhole(measurement.name)) return Error{"a measurement has no code that says what it is"};
  if (measurement.value && !std::isfinite(*measurement.value))
    return Error{measurement.name.meaning + " is not finite"};
  if (measurement.value && !isWhole(measurement.unit))
    return Error{measurement.name.meaning + " has no unit"};
  if (Status s = checkProperties(measurement.properties); !s) return s;
  return checkShapes(measurement.shapes, source);
}

Status checkGroup(const MeasurementGroup& group, const DocumentSource& source) {
  for (const ReportMeasurement& measurement : group.measurements)
    if (Status s = checkMeasurement(measurement, source); !s) return s;
  if (Status s = checkProperties(group.evaluations); !s) return s;
  if (Status s = checkShapes(group.shapes, source); !s) return s;
  return checkPictures(group.pictures, source);
}

bool isWritable(const Code& code) {
  constexpr std::size_t longestScheme = 16;
  if (code == Code{}) return true;
  return isWhole(code) && inOneLine(code.value) == code.value && code.scheme.size() <= longestScheme &&
         inOneLine(code.scheme) == code.scheme;
}

void visitAll(const std::vector<ReportProperty>& properties, const std::function<void(const Code&)>& visit) {
  for (const ReportProperty& property : properties) visit(property.name), visit(property.value);
}

void visitAll(const std::vector<ReportShape>& shapes, const std::function<void(const Code&)>& visit) {
  for (const ReportShape& shape : shapes) visit(shape.name);
}

}  // namespace

void forEachCode(const Report& report, const std::function<void(const Code& code)>& visit) {
  visit(report.title);
  for (const MeasurementGroup& group : report.groups) {
    visit(group.category), visit(group.finding), visit(group.site);
    visitAll(group.evaluations, visit);
    visitAll(group.shapes, visit);
    for (const ReportMeasurement& measurement : group.measurements) {
      visit(measurement.name), visit(measurement.unit);
      visitAll(measurement.properties, visit);
      visitAll(measurement.shapes, visit);
    }
  }
}

Status checkReport(const Report& report, const DocumentSource& source) {
  if (report.groups.empty()) return Error{"There is no measurement to write."};
  std::string wrong;
  forEachCode(report, [&](const Code& code) {
    if (!isWritable(code)) wrong = code.meaning.empty() ? code.value : code.meaning;
  });
  if (!wrong.empty())
    return Error{"The code of \"" + wrong +
                 "\" needs a value of at most 64 characters and a scheme of at most 16."};
  for (std::size_t n = 0; n < report.groups.size(); ++n)
    if (Status s = checkGroup(report.groups[n], source); !s)
      return Error{"Measurement " + std::to_string(n + 1) + ": " + s.message() + "."};
  return {};
}

}  // namespace volumen
