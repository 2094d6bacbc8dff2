#include "io/export/report_dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <charconv>

#include "io/export/dicom_modules.h"
#include "io/export/dicom_uid.h"
#include "io/export/report_check.h"

namespace volumen {

namespace {

Code dcm(const char* value, const char* meaning) { return {value, "DCM", meaning}; }

std::string graphicTypeOf(ReportShape::Type type) {
  std::string name = typeName(type);
  for (char& c : name) c = char(c - 'a' + 'A');
  return name;
}

// Coordinates are float32 in the file (FL).
std::string coordinatesOf(const ReportShape& shape) {
  std::string text;
  for (const glm::dvec3& p : shape.points)
    for (int c = 0; c < (shape.inPatient ? 3 : 2); ++c) {
      char digits[32];
      if (!text.empty()) text += '\\';
      text.append(digits, std::to_chars(digits, std::end(digits), float(p[c])).ptr);
    }
  return text;
}

/// Turns a report into content items (PS3.16 TID 1500).
class ReportContent {
 public:
  ReportContent(const Report& report, const DocumentSource& source) : report_(report), source_(source) {}

  ContentItem root() const {
    const Code title = isWhole(report_.title) ? report_.title : dcm("126000", "Imaging Measurement Report");
    ContentItem all = containerItem("", title, "1500");
    all.content.push_back(conceptItem("HAS CONCEPT MOD",
                                      dcm("121049", "Language of Content Item and Descendants"),
                                      {"en", "RFC5646", "English"}));
    addObserver(all);
    all.content.push_back(conceptItem("HAS CONCEPT MOD", dcm("121058", "Procedure reported"),
                                      {"363679005", "SCT", "Imaging procedure"}));
    addLibrary(all);
    ContentItem measurements = containerItem("CONTAINS", dcm("126010", "Imaging Measurements"));
    for (const MeasurementGroup& group : report_.groups) measurements.content.push_back(groupItem(group));
    all.content.push_back(std::move(measurements));
    return all;
  }

 private:
  static void addObserver(ContentItem& all) {
    constexpr const char* observer = "HAS OBS CONTEXT";
    const std::string program = "volumen";
    const std::string uid =
        DicomUids({reinterpret_cast<const std::uint8_t*>(program.data()), program.size()}, {}).of("device");
    all.content.push_back(conceptItem(observer, dcm("121005", "Observer Type"), dcm("121007", "Device")));
    all.content.push_back(uidItem(observer, dcm("121012", "Device Observer UID"), uid));
    all.content.push_back(textItem(observer, dcm("121013", "Device Observer Name"), program));
    all.content.push_back(textItem(observer, dcm("121014", "Device Observer Manufacturer"), program));
    all.content.push_back(
        textItem(observer, dcm("121015", "Device Observer Model Name"), "volumen " VOLUMEN_VERSION));
  }

  // PS3.16 TID 1600: all images that the report refers to.
  void addLibrary(ContentItem& all) const {
    ContentItem images = containerItem("CONTAINS", dcm("126200", "Image Library Group"));
    for (const std::string& uid : instancesOf(report_))
      if (source_.pictures.at(uid).isImage)
        images.content.push_back(pictureItem("CONTAINS", {}, {uid, {}, {}, {}}, source_));
    ContentItem library = containerItem("CONTAINS", dcm("111028", "Image Library"), "1600");
    if (!images.content.empty()) library.content.push_back(std::move(images));
    all.content.push_back(std::move(library));
  }

  static const char* templateOf(const MeasurementGroup& group) {
    const bool isOfSegment = std::ranges::any_of(
        group.pictures, [](const ReferencedPicture& picture) { return !picture.segments.empty(); });
    return isOfSegment ? "1411" : group.shapes.empty() ? "1501" : "1410";
  }

  ContentItem groupItem(const MeasurementGroup& group) const {
    ContentItem all = containerItem("CONTAINS", dcm("125007", "Measurement Group"), templateOf(group));
    const auto addCode = [&](const char* relationship, const Code& name, const Code& value) {
      if (isWhole(value)) all.content.push_back(conceptItem(relationship, name, value));
    };
    if (!group.trackingId.empty())
      all.content.push_back(
          textItem("HAS OBS CONTEXT", dcm("112039", "Tracking Identifier"), group.trackingId));
    all.content.push_back(uidItem("HAS OBS CONTEXT", dcm("112040", "Tracking Unique Identifier"),
                                  group.trackingUid.empty() ? randomUid() : group.trackingUid));
    addCode("CONTAINS", {"276214006", "SCT", "Finding category"}, group.category);
    addCode("CONTAINS", dcm("121071", "Finding"), group.finding);
    addCode("HAS CONCEPT MOD", {"363698007", "SCT", "Finding Site"}, group.site);
    for (const ReportProperty& said : group.evaluations) addCode("CONTAINS", said.name, said.value);
    for (const ReportShape& shape : group.shapes)
      all.content.push_back(shapeItem("CONTAINS", shape, dcm("111030", "Image Region")));
    for (const ReferencedPicture& picture : group.pictures)
      all.content.push_back(pictureItem("CONTAINS", nameIn(group, picture), picture, source_));
    for (const ReportMeasurement& measurement : group.measurements)
      all.content.push_back(measurementItem(measurement));
    return all;
  }

  // The images of a group are sources of its segment, or else of its numbers.
  Code nameIn(const MeasurementGroup& group, const ReferencedPicture& picture) const {
    if (!picture.segments.empty()) return dcm("121191", "Referenced Segment");
    const bool isOfSegment = std::string_view(templateOf(group)) == "1411";
    return isOfSegment ? dcm("121233", "Source image for segmentation")
                       : dcm("121112", "Source of Measurement");
  }

  ContentItem measurementItem(const ReportMeasurement& measurement) const {
    ContentItem all{"CONTAINS", "NUM", measurement.name, {{0x0040a300, {}}}};
    if (measurement.value) addValue(*measurement.value, measurement.unit, all.value);
    for (const ReportProperty& property : measurement.properties)
      all.content.push_back(conceptItem("HAS CONCEPT MOD", property.name, property.value));
    for (const ReportShape& shape : measurement.shapes)
      all.content.push_back(shapeItem("INFERRED FROM", shape, dcm("111030", "Image Region")));
    return all;
  }

  // A number that 16 characters do not hold exactly stands there as a double, too (PS3.3 C.18.1).
  static void addValue(double value, const Code& unit, DicomElements& out) {
    const std::string text = decimal(value);
    append(out, {{dicomItem, {}, 0, 1}, {0x0040a30a, text, 0, 1}});
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    if (read != value) {
      char digits[32];
      out.push_back({0x0040a161, {digits, std::to_chars(digits, std::end(digits), value).ptr}, 0, 1});
    }
    append(out, codeSequence(0x004008ea, unit, 1));
  }

  ContentItem shapeItem(const char* relationship, const ReportShape& shape, const Code& otherwise) const {
    ContentItem all{relationship, shape.inPatient ? "SCOORD3D" : "SCOORD",
                    isWhole(shape.name) ? shape.name : otherwise};
    all.value = {{0x00700022, coordinatesOf(shape)}, {0x00700023, graphicTypeOf(shape.type)}};
    if (shape.inPatient) all.value.push_back({0x30060024, shape.frameOfReferenceUid});
    for (const ReferencedPicture& picture : shape.pictures)
      all.content.push_back(pictureItem("SELECTED FROM", {}, picture, source_));
    return all;
  }

  const Report& report_;
  const DocumentSource& source_;
};

template <class Visit>
void forEachShape(const Report& report, const Visit& visit) {
  for (const MeasurementGroup& group : report.groups) {
    for (const ReportShape& shape : group.shapes) visit(shape);
    for (const ReportMeasurement& measurement : group.measurements)
      for (const ReportShape& shape : measurement.shapes) visit(shape);
  }
}

std::vector<std::string> notesOf(const Report& report) {
  std::vector<std::string> notes;
  forEachCode(report, [&](const Code& code) {
    if (inOneLine(code.meaning) != code.meaning)
      notes.push_back("The text of a code has one line of at most 64 characters: \"" +
                      inOneLine(code.meaning) + "\".");
  });
  return notes;
}

}  // namespace

std::vector<std::string> instancesOf(const Report& report) {
  std::vector<std::string> uids;
  const auto add = [&](const std::vector<ReferencedPicture>& pictures) {
    for (const ReferencedPicture& picture : pictures)
      if (std::ranges::find(uids, picture.sopInstanceUid) == uids.end())
        uids.push_back(picture.sopInstanceUid);
  };
  for (const MeasurementGroup& group : report.groups) add(group.pictures);
  forEachShape(report, [&](const ReportShape& shape) { add(shape.pictures); });
  return uids;
}

Result<std::vector<std::string>> writeReport(const Report& report, const DocumentSource& source,
                                             const std::string& path) {
  if (Status s = checkReport(report, source); !s) return s.error();
  bool isInPatient = false;
  forEachShape(report, [&](const ReportShape& shape) { isInPatient = isInPatient || shape.inPatient; });
  Document document{isInPatient ? UID_Comprehensive3DSRStorage : UID_ComprehensiveSRStorage, "SR",
                    "Measurements"};
  document.content = ReportContent(report, source).root();
  document.more = {{0x0040a372, {}}, {0x0040a491, "COMPLETE"}, {0x0040a493, "UNVERIFIED"}};
  if (Status s = writeDocument(document, source, path); !s) return s.error();
  return notesOf(report);
}

}  // namespace volumen
