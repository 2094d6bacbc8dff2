#include "viewer/measure/shape_json.h"

#include <cmath>
#include <limits>

#include "viewer/scene/fields.h"

namespace volumen {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

const Words<ShapeKind> kindWords = [] {
  Words<ShapeKind> words;
  for (const ShapeRule& rule : shapeRules()) words.emplace_back(rule.name, rule.kind);
  return words;
}();

ordered_json numbers(glm::dvec3 v) { return {v.x, v.y, v.z}; }

ordered_json placeOn(const Shape& shape, glm::dvec3 p) {
  return shape.frame ? ordered_json{p.x, p.y} : numbers(p);
}

ordered_json unitText(const std::string& unit) { return unit.empty() ? ordered_json() : ordered_json(unit); }

ordered_json rangeToJson(const ValueRange& range) {
  const auto end = [](double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(); };
  return {end(range.low), end(range.high)};
}

// A range is [low, high]; null stands for no end.
void rangeField(Fields& f, ValueRange& range) {
  f.write("range", rangeToJson(range));
  const json* ends = f.raw("range");
  f.require("range", !f.reading() || ends, "is missing");
  if (!ends) return;
  if (!ends->is_array() || ends->size() != 2)
    return f.refuse(f.pathOf("range"), "must be [low, high], null for no end");
  range = {-infinity, infinity};
  for (std::size_t n = 0; n < 2; ++n) {
    const json& end = (*ends)[n];
    if (end.is_number())
      (n == 0 ? range.low : range.high) = end.get<double>();
    else if (!end.is_null())
      f.refuse(f.pathOf("range", n), "must be a number, or null for no end");
  }
}

// Adds SUVpeak and the position of its ball.
void addPeak(ordered_json& out, const std::optional<ValuePeak>& peak) {
  if (peak) out["suvPeak"] = {{"mean", peak->mean}, {"centre", numbers(peak->centre)}, {"ml", 1}};
}

void addStatistics(ordered_json& out, const ValueStatistics& values, const std::string& unit) {
  out["mean"] = values.mean;
  out["sd"] = values.sd;
  out["min"] = values.min;
  out["max"] = values.max;
  out["valueUnit"] = unitText(unit);
}

void addOther(ordered_json& out, const OtherValues& other) {
  ordered_json& o = out["other"];
  o["series"] = other.source;
  o["voxels"] = other.values ? other.values->n : 0;
  if (!other.values) {
    o["problem"] = "no voxel inside";
    return;
  }
  addStatistics(o, *other.values, other.unit);
  addPeak(o, other.peak);
}

void addTwoLines(ordered_json& out, ShapeKind kind, const TwoLines& lines) {
  if (kind == ShapeKind::cardiothoracic) {
    out["heart"] = lines.first;
    out["thorax"] = lines.second;
    out["lengthUnit"] = lines.unit;
    return;
  }
  out["short"] = lines.second;
  out["product"] = lines.first * lines.second;
  out["productUnit"] = lines.unit + "^2";
}

void addLegAxis(ordered_json& out, const LegAxis& leg) {
  out["hka"] = leg.hka;
  if (leg.bend != LegAxis::Bend::unknown) out["bend"] = leg.bend == LegAxis::Bend::varus ? "varus" : "valgus";
}

void addRegion(ordered_json& out, const Measured& m) {
  if (m.frame && m.frame->colour) return;
  out[m.frame ? "pixels" : "voxels"] = m.values ? m.values->n : 0;
  if (!m.values && m.frame) {
    out["problem"] = "no pixel inside";
    return;
  }
  if (m.values) {
    addStatistics(out, *m.values, m.valueUnit);
    addPeak(out, m.peak);
  } else {
    out["problem"] = "no voxel inside";
  }
  if (m.other) addOther(out, *m.other);
}

void addProbe(ordered_json& out, const Shape& shape, const Measured& m) {
  out["point"] = placeOn(shape, shape.points[0]);
  if (m.frame) {
    out["index"] = {m.voxel->index.x, m.voxel->index.y};
    if (m.frame->rgb) out["rgb"] = {m.frame->rgb->x, m.frame->rgb->y, m.frame->rgb->z};
    if (!m.frame->colour) out["padding"] = m.voxel->padding;
    return;
  }
  out["index"] = {m.voxel->index.x, m.voxel->index.y, m.voxel->index.z};
  out["voxelCentre"] = numbers(m.voxel->centre);
  out["padding"] = m.voxel->padding;
}

void addReading(ordered_json& out, const char* name, const std::optional<AxisReading>& reading) {
  if (reading) out[name] = {{"number", reading->number}, {"unit", reading->unit}};
}

void addFrame(ordered_json& out, const FrameReading& frame) {
  if (!frame.calibration.empty()) out["calibration"] = frame.calibration;
  addReading(out, "across", frame.across);
  addReading(out, "down", frame.down);
}

void addVolume(ordered_json& out, const Shape& shape, const Measured& m) {
  out["range"] = rangeToJson(shape.range);
  out["voxels"] = m.segment->voxels;
  out["drawn"] = *m.drawn;
  out["difference"] = *m.drawn - m.number;
  out["valueUnit"] = unitText(m.valueUnit);
}

}  // namespace

static void fields(Fields& f, ShapeFrame& frame) {
  f.needed("instance", frame.instance);
  f("number", frame.number);
}

static void fields(Fields& f, ShapePlane& plane) {
  f.needed("centre", plane.centre);
  f.needed("right", plane.right);
  f.needed("down", plane.down);
}

// Points in the patient are in mm, those of frames in pixels.
static void fields(Fields& f, Shape& shape) {
  f.needed("kind", shape.kind, kindWords);
  f.unless({}, "name", shape.name);
  if (shape.kind == ShapeKind::volume) return rangeField(f, shape.range);
  f.unlessMissing("frame", shape.frame);
  f.unless({}, "points", shape.points,
           shape.frame ? PointRule{"must be a list of [x, y] in pixels", 2}
                       : PointRule{"must be a list of [x, y, z] in mm"});
  if (shape.frame && ruleOf(shape.kind).region) shape.plane.emplace();
  if (shape.frame) return;
  f.unlessMissing("plane", shape.plane);
  f.unlessMissing("softMm", shape.softMm);
}

void shapeFields(JsonFields object, Shape& shape) {
  Fields f(std::move(object));
  fields(f, shape);
  f.refuseOthers();
}

std::string shapesToJson(const std::vector<Shape>& shapes,
                         const std::vector<std::pair<std::string, std::string>>& series) {
  std::string text;
  for (const Shape& shape : shapes) {
    ordered_json out = jsonOf(shape);
    for (const auto& [name, value] : series) out["series"][name] = value;
    text += (text.empty() ? "[" : ",\n ") + out.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }
  return (text.empty() ? "[" : text) + "]\n";
}

Result<std::vector<Shape>> shapesFromJson(const std::string& text) {
  const auto parsed = parseJson(text);
  if (!parsed) return parsed.error();
  if (!parsed->is_array()) return Error{"The JSON must be a list of shapes, [{\"kind\": ...}, ...]."};
  std::vector<Shape> shapes;
  for (const json& item : *parsed) {
    const std::string path = "[" + std::to_string(shapes.size()) + "]";
    std::string problem;
    json shape = item;
    if (shape.is_object()) shape.erase("series");
    shapeFields(JsonFields(shape, path, problem), shapes.emplace_back());
    if (!problem.empty()) return Error{problem};
    if (const Status valid = checkShape(shapes.back()); !valid) return Error{path + "." + valid.message()};
  }
  return shapes;
}

ordered_json measuredToJson(const Shape& shape, const Result<Measured>& measured) {
  ordered_json out{{"kind", ruleOf(shape.kind).name}};
  if (!shape.name.empty()) out["name"] = shape.name;
  if (shape.frame) out["frame"] = jsonOf(*shape.frame);
  if (!measured) {
    out["problem"] = measured.message();
    return out;
  }
  const bool isColour = measured->frame && measured->frame->rgb;
  out["number"] = isColour ? ordered_json() : ordered_json(measured->number);
  out["unit"] = unitText(measured->unit);
  if (measured->frame) addFrame(out, *measured->frame);
  if (measured->plusMinus) out["plusMinus"] = *measured->plusMinus;
  if (measured->leg) addLegAxis(out, *measured->leg);
  if (measured->lines) addTwoLines(out, shape.kind, *measured->lines);
  if (ruleOf(shape.kind).region) addRegion(out, *measured);
  if (measured->voxel) addProbe(out, shape, *measured);
  if (measured->segment) addVolume(out, shape, *measured);
  return out;
}

}  // namespace volumen
