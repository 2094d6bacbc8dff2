#include "viewer/scene/scene_json.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/json_fields.h"
#include "viewer/scene/modes.h"

namespace volumen {

namespace {

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
void readDirection(JsonFields& fields, const char* name, glm::dvec3& direction) {
  fields.read(name, direction);
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (largest > 1e100 || (largest > 0 && largest < 1e-100)) direction /= largest;
}

CurvePoint readPoint(JsonFields fields) {
  CurvePoint point = shownPoint;
  fields.read("value", point.value);
  fields.read("colour", point.colour);
  fields.read("opacity", point.opacity);
  fields.refuseOthers();
  return point;
}

GradientOpacityPoint readGradientPoint(JsonFields fields) {
  GradientOpacityPoint point;
  fields.read("gradient", point.gradient);
  fields.read("factor", point.factor);
  fields.refuseOthers();
  return point;
}

void readTransferFunction(JsonFields fields, TransferFunction& curve) {
  fields.read("unitDistance", curve.unitDistance);
  fields.readList("points", curve.points, readPoint);
  fields.readList("gradientOpacity", curve.gradientOpacity, readGradientPoint);
  fields.refuseOthers();
}

void readShading(JsonFields fields, Shading& shading) {
  fields.read("lit", shading.lit);
  fields.read("sides", shading.sides);
  fields.read("localViewer", shading.localViewer);
  if (fields.given("gradientFloor")) fields.read("gradientFloor", shading.gradientFloor.emplace());
  fields.read("ambient", shading.ambient);
  fields.read("diffuse", shading.diffuse);
  fields.read("specular", shading.specular);
  fields.read("shininess", shading.shininess);
  fields.refuseOthers();
}

Light readLight(JsonFields fields) {
  Light light;
  readDirection(fields, "direction", light.direction);
  fields.read("space", light.space, spaceWords);
  fields.read("colour", light.colour);
  fields.read("intensity", light.intensity);
  fields.read("on", light.on);
  fields.refuseOthers();
  return light;
}

Camera readCamera(JsonFields fields) {
  Camera camera;
  if (fields.given("target")) fields.read("target", camera.target.emplace());
  readDirection(fields, "direction", camera.direction);
  readDirection(fields, "up", camera.up);
  fields.read("projection", camera.projection, projectionWords);
  fields.read("height", camera.height);
  fields.read("fov", camera.fov);
  fields.read("distance", camera.distance);
  fields.refuseOthers();
  return camera;
}

ClipPlane readPlane(JsonFields fields) {
  ClipPlane plane = shownPlane;
  readDirection(fields, "normal", plane.normal);
  fields.read("offset", plane.offset);
  fields.refuseOthers();
  return plane;
}

void readClip(JsonFields fields, Clip& clip) {
  if (const auto* box = fields.raw("box")) {
    if (!box->is_array() || box->size() != 3)
      fields.refuse(fields.pathOf("box"), "must be a list of three [low, high] pairs");
    else
      for (int a = 0; a < 3; ++a) {
        double pair[] = {clip.boxLow[a], clip.boxHigh[a]};
        fields.readNumbers((*box)[std::size_t(a)], fields.pathOf("box", std::size_t(a)), pair, 2);
        clip.boxLow[a] = pair[0];
        clip.boxHigh[a] = pair[1];
      }
  }
  fields.readList("planes", clip.planes, readPlane);
  fields.refuseOthers();
}

Window readWindow(JsonFields fields) {
  Window window;
  fields.read("centre", window.centre);
  fields.read("width", window.width);
  fields.refuseOthers();
  return window;
}

void readBackground(JsonFields& fields, Background& background) {
  const auto* field = fields.raw("background");
  if (!field) return;
  if (*field == "transparent")
    background.transparent = true;
  else if (field->is_string())
    fields.refuse("background", "must be a colour or \"transparent\", not " +
                                    JsonFields::quoted(field->get<std::string>()));
  else
    fields.readNumbers(*field, "background", &background.colour[0], 3);
}

void readScene(JsonFields fields, Scene& scene) {
  int version = 1;
  fields.read("volumenScene", version);
  if (version != 1)
    fields.refuse("volumenScene", "must be 1, the version of the format, not " + std::to_string(version));
  fields.read("mode", scene.mode, modeWords);
  if (auto window = fields.objectOrNull("window")) scene.window = readWindow(*window);
  if (auto curve = fields.object("transferFunction")) readTransferFunction(*curve, scene.transferFunction);
  if (auto shading = fields.object("shading")) readShading(*shading, scene.shading);
  fields.readList("lights", scene.lights, readLight);
  if (auto camera = fields.objectOrNull("camera")) scene.camera = readCamera(*camera);
  if (auto clip = fields.object("clip")) readClip(*clip, scene.clip);
  readBackground(fields, scene.background);
  fields.refuseOthers();
}

}  // namespace

Result<Scene> sceneFromJson(const std::string& text) {
  const auto parsed = parseJson(text);
  if (!parsed) return parsed.error();
  std::string problem;
  Scene scene;
  readScene(JsonFields(*parsed, "", problem), scene);
  if (!problem.empty()) return Error{problem};
  if (const Status valid = validateScene(scene); !valid) return valid.error();
  return scene;
}

}  // namespace volumen
