#include "app/derived_json.h"

#include "app/printable.h"
#include "io/contours.h"
#include "io/presentation.h"
#include "io/report.h"
#include "io/segmentation.h"
#include "io/study/iso_date.h"
#include "io/zip_archive.h"
#include "results/numbers/code_json.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

template <class Item, class Read>
Json listOf(const std::vector<Item>& items, const Read& read) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(read(item));
  return list;
}

Json pointJson(glm::dvec2 p) { return {p.x, p.y}; }
Json pointJson(glm::dvec3 p) { return {p.x, p.y, p.z}; }

Json colourJson(const std::optional<glm::u8vec3>& colour) {
  return colour ? Json{colour->x, colour->y, colour->z} : Json();
}

Json pictureJson(const ReferencedPicture& p) {
  Json out{{"sopInstanceUid", p.sopInstanceUid}, {"seriesUid", p.seriesUid}};
  if (!p.frames.empty()) out["frames"] = p.frames;
  if (!p.segments.empty()) out["segments"] = p.segments;
  return out;
}

Json picturesJson(const std::vector<ReferencedPicture>& pictures) { return listOf(pictures, pictureJson); }

const char* unitsName(AnnotationUnits units) { return units == AnnotationUnits::pixel ? "pixel" : "display"; }

Json greyJson(const NamedGrey& grey) {
  constexpr const char* functions[] = {"LINEAR", "LINEAR_EXACT", "SIGMOID"};
  const GreyMapping& m = grey.mapping;
  if (!m.table.grey.empty())
    return {{"name", grey.name}, {"tableFirst", m.table.first}, {"tableEntries", m.table.grey.size()}};
  return {{"name", grey.name},
          {"centre", m.window.centre},
          {"width", m.window.width},
          {"function", functions[int(m.function)]}};
}

Json graphicJson(const Graphic& g) {
  constexpr const char* types[] = {"point", "polyline", "interpolated", "circle", "ellipse"};
  return {{"type", types[int(g.type)]},
          {"layer", g.layer},
          {"units", unitsName(g.units)},
          {"filled", g.filled},
          {"points", listOf(g.points, [](glm::dvec2 p) { return pointJson(p); })}};
}

Json textJson(const GraphicText& t) {
  Json out{{"text", t.text}, {"layer", t.layer}};
  if (t.box)
    out["box"] = {{"topLeft", pointJson(t.box->topLeft)},
                  {"bottomRight", pointJson(t.box->bottomRight)},
                  {"units", unitsName(t.box->units)}};
  if (t.anchor)
    out["anchor"] = {{"point", pointJson(t.anchor->point)},
                     {"units", unitsName(t.anchor->units)},
                     {"visible", t.anchor->visible}};
  return out;
}

Json shutterJson(const Shutter& shutter) {
  constexpr const char* kinds[] = {"rectangle", "circle", "polygon"};
  return {
      {"grey", shutter.grey},
      {"shapes", listOf(shutter.shapes, [&](const ShutterShape& s) { return Json(kinds[int(s.kind)]); })}};
}

Json contents(const Presentation& p) {
  const auto annotations = [](const Presentation::Annotations& a) {
    return Json{{"of", picturesJson(a.of)},
                {"graphics", listOf(a.graphics, graphicJson)},
                {"texts", listOf(a.texts, textJson)}};
  };
  const auto layer = [](const GraphicLayer& l) {
    return Json{
        {"name", l.name}, {"description", l.description}, {"grey", l.grey}, {"colour", colourJson(l.colour)}};
  };
  return {{"values",
           {{"slope", p.values.slope},
            {"intercept", p.values.intercept},
            {"tableEntries", p.values.table.size()}}},
          {"greys", listOf(p.greys,
                           [](const Presentation::Greys& g) {
                             return Json{{"of", picturesJson(g.of)}, {"greys", listOf(g.greys, greyJson)}};
                           })},
          {"inverted", p.inverted},
          {"shutter", shutterJson(p.shutter)},
          {"rotation", 90 * p.turn.quarters},
          {"mirrored", p.turn.mirrored},
          {"areas", listOf(p.areas,
                           [](const Presentation::Area& a) {
                             return Json{{"of", picturesJson(a.of)},
                                         {"from", pointJson(glm::dvec2(a.area.from))},
                                         {"to", pointJson(glm::dvec2(a.area.to))}};
                           })},
          {"layers", listOf(p.layers, layer)},
          {"annotations", listOf(p.annotations, annotations)},
          {"warnings", p.warnings}};
}

Json propertyJson(const ReportProperty& p) {
  return {{"name", codeJson(p.name)}, {"value", codeJson(p.value)}};
}

Json shapeJson(const ReportShape& s) {
  Json out{{"type", typeName(s.type)},
           {"name", codeJson(s.name)},
           {"space", s.inPatient ? "patient" : "pixel"},
           {"points", Json::array()},
           {"pictures", picturesJson(s.pictures)}};
  for (const glm::dvec3 p : s.points)
    out["points"].push_back(s.inPatient ? pointJson(p) : pointJson(glm::dvec2(p)));
  if (s.inPatient) out["frameOfReferenceUid"] = s.frameOfReferenceUid;
  return out;
}

Json measurementJson(const ReportMeasurement& m) {
  return {{"name", codeJson(m.name)},
          {"value", m.value ? Json(*m.value) : Json()},
          {"unit", codeJson(m.unit)},
          {"properties", listOf(m.properties, propertyJson)},
          {"shapes", listOf(m.shapes, shapeJson)}};
}

Json groupJson(const MeasurementGroup& g) {
  return {{"trackingId", g.trackingId},
          {"trackingUid", g.trackingUid},
          {"category", codeJson(g.category)},
          {"finding", codeJson(g.finding)},
          {"site", codeJson(g.site)},
          {"evaluations", listOf(g.evaluations, propertyJson)},
          {"measurements", listOf(g.measurements, measurementJson)},
          {"shapes", listOf(g.shapes, shapeJson)},
          {"pictures", picturesJson(g.pictures)}};
}

Json contents(const Report& r) {
  return {{"title", codeJson(r.title)}, {"groups", listOf(r.groups, groupJson)}, {"warnings", r.warnings}};
}

Json contents(const KeyObjects& k) {
  return {{"title", codeJson(k.title)}, {"text", k.text}, {"pictures", picturesJson(k.pictures)}};
}

Json contourJson(const Contour& c) {
  return {{"type", typeName(c.type)},
          {"areaMm2", areaOf(c)},
          {"points", listOf(c.points, [](glm::dvec3 p) { return pointJson(p); })}};
}

Json regionJson(const RegionOfInterest& r) {
  return {{"number", r.number},
          {"name", r.name},
          {"type", r.type},
          {"colour", colourJson(r.colour)},
          {"frameOfReferenceUid", r.frameOfReferenceUid},
          {"contours", listOf(r.contours, contourJson)}};
}

Json contents(const StructureSet& s) {
  return {{"label", s.label},
          {"name", s.name},
          {"description", s.description},
          {"regions", listOf(s.regions, regionJson)},
          {"warnings", s.warnings}};
}

Json contents(const Segmentation& s) {
  Json segments = Json::array();
  for (std::size_t n = 0; n < s.segments.size(); ++n) {
    const Segment& segment = s.segments[n];
    segments.push_back({{"number", segment.number},
                        {"label", segment.label},
                        {"category", codeJson(segment.category)},
                        {"type", codeJson(segment.type)},
                        {"modifier", codeJson(segment.modifier)},
                        {"region", codeJson(segment.region)},
                        {"regionModifier", codeJson(segment.regionModifier)},
                        {"algorithmType", segmentAlgorithmTerms[std::size_t(segment.algorithmType)]},
                        {"algorithm", segment.algorithm},
                        {"trackingId", segment.trackingId},
                        {"trackingUid", segment.trackingUid},
                        {"colour", colourJson(segment.colour)},
                        {"pixels", pixelsOf(s, n)}});
  }
  return {{"fractional", s.fractional}, {"columns", s.size.x},  {"rows", s.size.y},
          {"frames", s.frames.size()},  {"segments", segments}, {"warnings", s.notes}};
}

template <class Value>
Result<Json> toJson(const Result<Value>& loaded) {
  if (!loaded) return loaded.error();
  return contents(*loaded);
}

}  // namespace

Json derivedToJson(const DerivedObject& object) {
  return {{"id", object.id},
          {"path", pathForJson(lastingPath(object.path))},
          {"kind", kindName(object.kind)},
          {"patient", {{"name", object.patientName}, {"id", object.patientId}}},
          {"studyUid", object.studyUid},
          {"seriesUid", object.seriesUid},
          {"modality", object.modality},
          {"label", object.label},
          {"text", object.text},
          {"date", isoDate(object.date)},
          {"warnings", object.warnings},
          {"notHere", object.notHere},
          {"pictures", picturesJson(object.pictures)}};
}

Result<Json> contentsToJson(const DerivedObject& object) {
  switch (object.kind) {
    case DerivedKind::presentation:
      return toJson(loadPresentation(object.path));
    case DerivedKind::keyObjects:
      return toJson(loadKeyObjects(object.path));
    case DerivedKind::report:
      return toJson(loadReport(object.path));
    case DerivedKind::contours:
      return toJson(loadContours(object.path));
    case DerivedKind::segmentation:
      break;
  }
  return toJson(loadSegmentation(object.path));
}

}  // namespace volumen
