#include "viewer/scene/scene_json.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/fields.h"
#include "viewer/scene/modes.h"
#include "viewer/scene/number_text.h"

namespace volumen {

namespace {

using SceneText = JsonFields::Json;

const Words<Mode> modeWords = [] {
  Words<Mode> words;
  for (const ModeRow& row : modeRows()) words.emplace_back(row.name, row.mode);
  return words;
}();
const Words<Space> spaceWords{{"camera", Space::camera}, {"patient", Space::patient}};
const Words<Projection> projectionWords{{"parallel", Projection::parallel},
                                        {"perspective", Projection::perspective}};

// List elements default to the values that picture.md 8 shows for them.
constexpr CurvePoint shownPoint{150, {0.9, 0.8, 0.7}, 0};
constexpr ClipPlane shownPlane{{0, 0, 1}, 50};

// The length of a direction is meaningless, but its square must not overflow.
void directionField(Fields& f, const char* name, glm::dvec3& direction) {
  f(name, direction);
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (largest > 1e100 || (largest > 0 && largest < 1e-100)) direction /= largest;
}

// A box is a list of three [low, high] pairs.
void boxField(Fields& f, glm::dvec3& low, glm::dvec3& high) {
  SceneText pairs;
  for (int a = 0; a < 3; ++a) pairs.push_back({low[a], high[a]});
  f.write("box", std::move(pairs));
  const auto* box = f.raw("box");
  if (!box) return;
  if (!box->is_array() || box->size() != 3)
    return f.refuse(f.pathOf("box"), "must be a list of three [low, high] pairs");
  for (int a = 0; a < 3; ++a) {
    double pair[] = {low[a], high[a]};
    f.readNumbers((*box)[std::size_t(a)], f.pathOf("box", std::size_t(a)), pair, 2);
    low[a] = pair[0];
    high[a] = pair[1];
  }
}

void backgroundField(Fields& f, Background& background) {
  const auto* field = f.raw("background");
  if (field ? !field->is_string() : !background.transparent) return f("background", background.colour);
  std::string word = "transparent";
  f("background", word);
  f.require("background", word == "transparent",
            "must be a colour or \"transparent\", not " + JsonFields::quoted(word));
  background.transparent = true;
}

}  // namespace

static void fields(Fields& f, Window& window) {
  f("centre", window.centre);
  f("width", window.width);
}

static void fields(Fields& f, CurvePoint& point) {
  f("value", point.value);
  f("colour", point.colour);
  f("opacity", point.opacity);
}

static void fields(Fields& f, GradientOpacityPoint& point) {
  f("gradient", point.gradient);
  f("factor", point.factor);
}

static void fields(Fields& f, TransferFunction& curve) {
  f("unitDistance", curve.unitDistance);
  f("points", curve.points, shownPoint);
  f("gradientOpacity", curve.gradientOpacity);
}

static void fields(Fields& f, Shading& shading) {
  f("lit", shading.lit);
  f("sides", shading.sides);
  f("localViewer", shading.localViewer);
  f("gradientFloor", shading.gradientFloor);
  f("ambient", shading.ambient);
  f("diffuse", shading.diffuse);
  f("specular", shading.specular);
  f("shininess", shading.shininess);
}

static void fields(Fields& f, Light& light) {
  directionField(f, "direction", light.direction);
  f("space", light.space, spaceWords);
  f("colour", light.colour);
  f("intensity", light.intensity);
  f("on", light.on);
}

static void fields(Fields& f, Camera& camera) {
  f("target", camera.target);
  directionField(f, "direction", camera.direction);
  directionField(f, "up", camera.up);
  f("projection", camera.projection, projectionWords);
  f("height", camera.height);
  f("fov", camera.fov);
  f("distance", camera.distance);
}

static void fields(Fields& f, ClipPlane& plane) {
  directionField(f, "normal", plane.normal);
  f("offset", plane.offset);
}

static void fields(Fields& f, Clip& clip) {
  boxField(f, clip.boxLow, clip.boxHigh);
  f("planes", clip.planes, shownPlane);
}

static void fields(Fields& f, Scene& scene) {
  int version = 1;
  f("volumenScene", version);
  f.require("volumenScene", version == 1,
            "must be 1, the version of the format, not " + std::to_string(version));
  f("mode", scene.mode, modeWords);
  f("window", scene.window);
  f("transferFunction", scene.transferFunction);
  f("shading", scene.shading);
  f("lights", scene.lights);
  f("camera", scene.camera);
  f("clip", scene.clip);
  backgroundField(f, scene.background);
}

namespace {

// Scene files are read and edited by people, so the layout is fixed: one line per point, light or plane.
// The line that holds the field `name` is indented by `column` spaces.
std::string laidOut(const std::string& name, const SceneText& value, std::size_t column) {
  if (value.is_number_float()) return numberText(value.get<double>());
  if (!value.is_structured()) return value.dump();
  const bool isList = value.is_array();
  const bool areLines =
      isList ? !value.empty() && value[0].is_object() : name.empty() || name == "transferFunction";
  const std::size_t inside = column + (areLines ? 2 : name.size() + std::string("\"\": {").size());
  std::string all;
  for (const auto& [key, part] : value.items()) {
    const bool isNewLine = areLines || key == "ambient" || key == "projection" || key == "planes";
    if (!all.empty()) all += isNewLine ? "," : ", ";
    if (isNewLine) all += "\n" + std::string(inside, ' ');
    if (!isList) all += '"' + key + "\": ";
    all += laidOut(key, part, inside);
  }
  if (areLines) all += "\n" + std::string(column, ' ');
  return isList ? "[" + all + "]" : "{" + all + "}";
}

}  // namespace

Result<Scene> sceneFromJson(const std::string& text) {
  const auto parsed = parseJson(text);
  if (!parsed) return parsed.error();
  std::string problem;
  Scene scene;
  Fields f(JsonFields(*parsed, "", problem));
  fields(f, scene);
  f.refuseOthers();
  if (!problem.empty()) return Error{problem};
  if (const Status valid = validateScene(scene); !valid) return valid.error();
  return scene;
}

std::string sceneToJson(const Scene& scene) { return laidOut("", jsonOf(scene), 0) + "\n"; }

}  // namespace volumen
