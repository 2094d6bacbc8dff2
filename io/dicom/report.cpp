#include "io/report.h"

#include <algorithm>
#include <cmath>

#include "io/dicom/derived_object.h"
#include "io/dicom/isolated_file.h"
#include "io/worker/object_fields.h"

namespace volumen {
namespace dicom {
namespace {

using Scope = DataSet::Scope;

constexpr std::uint32_t content = 0x0040a730, conceptName = 0x0040a043;

Code nameOf(const DataSet& data, Scope item) { return codeAt(data, conceptName, item); }

/// Reads a report. Content items are walked without recursion.
class ReportReader {
 public:
  explicit ReportReader(const DataSet& data) : data_(data) {}

  Report run() {
    out_.title = nameOf(data_, data_.root());
    std::vector<Scope> open{data_.root()};
    while (!open.empty()) {
      const Scope item = open.back();
      open.pop_back();
      const bool isGroup = typeOf(item) == "CONTAINER" && nameOf(data_, item).value == "125007";
      if (isGroup) out_.groups.push_back(readGroup(item));
      const std::vector<Scope> inside = data_.items(content, item);
      if (!isGroup) open.insert(open.end(), inside.rbegin(), inside.rend());
    }
    return std::move(out_);
  }

 private:
  std::string typeOf(Scope item) const { return data_.text(0x0040a040, item); }
  Code valueCode(Scope item) const { return codeAt(data_, 0x0040a168, item); }

  MeasurementGroup readGroup(Scope group) {
    MeasurementGroup out;
    for (const Scope item : data_.items(content, group)) {
      const std::string type = typeOf(item);
      if (type == "CODE") addCode(item, out);
      if (type == "TEXT" && nameOf(data_, item).value == "112039")
        out.trackingId = data_.utf8(0x0040a160, item);
      if (type == "UIDREF" && nameOf(data_, item).value == "112040")
        out.trackingUid = data_.utf8(0x0040a124, item);
      if (type == "NUM") out.measurements.push_back(readMeasurement(item));
      if (isShape(type)) addShape(item, type, out.shapes);
      if (type == "IMAGE" || type == "COMPOSITE") {
        const auto pictures = readPictures(data_, data_.contents(0x00081199, item));
        out.pictures.insert(out.pictures.end(), pictures.begin(), pictures.end());
      }
    }
    return out;
  }

  void addCode(Scope item, MeasurementGroup& out) const {
    const Code name = nameOf(data_, item), value = valueCode(item);
    if (name.value == "121071")
      out.finding = value;
    else if (name.value == "276214006")
      out.category = value;
    else if (name.value == "363698007" || name.value == "G-C0E3")
      out.site = value;
    else
      out.evaluations.push_back({name, value});
  }

  ReportMeasurement readMeasurement(Scope item) {
    ReportMeasurement out;
    out.name = nameOf(data_, item);
    if (const auto values = data_.items(0x0040a300, item); !values.empty()) {
      const std::optional<double> exact = data_.real(0x0040a161, values[0]);
      out.value = exact && std::isfinite(*exact) ? exact : data_.number(0x0040a30a, values[0]);
      out.unit = codeAt(data_, 0x004008ea, values[0]);
    }
    for (const Scope child : data_.items(content, item)) {
      const std::string type = typeOf(child);
      if (type == "CODE") out.properties.push_back({nameOf(data_, child), valueCode(child)});
      if (isShape(type)) addShape(child, type, out.shapes);
    }
    return out;
  }

  static bool isShape(const std::string& type) { return type == "SCOORD" || type == "SCOORD3D"; }

  void addShape(Scope item, const std::string& type, std::vector<ReportShape>& shapes) {
    ReportShape shape;
    shape.inPatient = type == "SCOORD3D";
    shape.name = nameOf(data_, item);
    shape.frameOfReferenceUid = data_.text(0x30060024, item);
    shape.pictures = readPictures(data_, data_.contents(content, item));
    const std::string graphic = data_.text(0x00700023, item);
    if (readPoints(item, graphic, shape))
      shapes.push_back(std::move(shape));
    else
      out_.warnings.push_back("A shape \"" + toUtf8(graphic, {}) +
                              "\" is left out: its type or its points are not those of the standard.");
  }

  /// Reads the points of a shape. Returns false if type or points do not conform to the standard.
  bool readPoints(Scope item, const std::string& graphic, ReportShape& shape) const {
    using Type = ReportShape::Type;
    struct Rule {
      const char* name;
      Type type;
      std::size_t least, most;
    };
    constexpr std::size_t any = SIZE_MAX;
    constexpr Rule rules[] = {{"POINT", Type::point, 1, 1},         {"MULTIPOINT", Type::multipoint, 1, any},
                              {"POLYLINE", Type::polyline, 2, any}, {"POLYGON", Type::polygon, 3, any},
                              {"CIRCLE", Type::circle, 2, 2},       {"ELLIPSE", Type::ellipse, 4, 4},
                              {"ELLIPSOID", Type::ellipsoid, 6, 6}};
    const auto* rule = std::ranges::find(rules, graphic, &Rule::name);
    const std::vector<float> numbers = data_.floats(0x00700022, item);
    const std::size_t dimensions = shape.inPatient ? 3 : 2, count = numbers.size() / dimensions;
    if (rule == std::end(rules) || numbers.size() % dimensions != 0 || count < rule->least ||
        count > rule->most || !std::ranges::all_of(numbers, [](float v) { return std::isfinite(v); }))
      return false;
    shape.type = rule->type;
    for (std::size_t n = 0; n < numbers.size(); n += dimensions)
      shape.points.emplace_back(numbers[n], numbers[n + 1], shape.inPatient ? numbers[n + 2] : 0);
    return true;
  }

  const DataSet& data_;
  Report out_;
};

}  // namespace
}  // namespace dicom

namespace {

Result<Report> loadReportHere(const std::string& path) {
  return dicom::loadObject<Report>(path, DerivedKind::report,
                                   [](const dicom::InspectedFile&, const dicom::DataSet& data) {
                                     return Result<Report>(dicom::ReportReader(data).run());
                                   });
}

}  // namespace

Result<Report> loadReport(const std::string& path) { return dicom::isolatedFile<loadReportHere>(path, 0); }

namespace {

Result<KeyObjects> loadKeyObjectsHere(const std::string& path) {
  return dicom::loadObject<KeyObjects>(
      path, DerivedKind::keyObjects, [](const dicom::InspectedFile& file, const dicom::DataSet& data) {
        return Result<KeyObjects>(
            KeyObjects{dicom::nameOf(data, data.root()), file.found.derivedObject->text,
                       dicom::readPictures(data, data.contents(dicom::content, data.root()))});
      });
}

}  // namespace

Result<KeyObjects> loadKeyObjects(const std::string& path) {
  return dicom::isolatedFile<loadKeyObjectsHere>(path, 0);
}

const char* typeName(ReportShape::Type type) {
  constexpr const char* names[] = {"point",  "multipoint", "polyline", "polygon",
                                   "circle", "ellipse",    "ellipsoid"};
  return names[int(type)];
}

}  // namespace volumen
