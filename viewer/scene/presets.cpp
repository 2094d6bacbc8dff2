#include "viewer/scene/presets.h"

#include <algorithm>
#include <cassert>

#include "viewer/scene/automatic.h"
#include "viewer/scene/fields.h"
#include "viewer/scene/preset_texts.h"
#include "viewer/scene/scene_json.h"
#include "viewer/scene/similar_name.h"

namespace volumen {

namespace {

void anchor(Scene& scene, ValueRange from, ValueRange to) {
  // A constant volume has no range to map to; its value then counts as `high`.
  const double scale = to.high > to.low ? (to.high - to.low) / (from.high - from.low) : 1;
  const auto moved = [&](double value) { return to.high + (value - from.high) * scale; };
  for (CurvePoint& p : scene.transferFunction.points) p.value = float(moved(double(p.value)));
  for (GradientOpacityPoint& p : scene.transferFunction.gradientOpacity) p.gradient *= scale;
  if (scene.window) scene.window = Window{moved(scene.window->centre), scene.window->width * scale};
}

// Light over the left shoulder, and a weak one from the other side, so that nothing is black.
std::vector<Light> shoulderLights() {
  return {{.direction = {-0.5, 0.5, 1}}, {.direction = {0.8, -0.3, 0.6}, .intensity = 0.25}};
}

const Preset* found(const std::vector<Preset>& presets, const std::string& name) {
  const auto at =
      std::find_if(presets.begin(), presets.end(), [&](const Preset& preset) { return preset.name == name; });
  return at == presets.end() ? nullptr : &*at;
}

}  // namespace

static void fields(Fields& f, ValueRange& anchor) {
  f("low", anchor.low);
  f("high", anchor.high);
  f.require("high", anchor.low < anchor.high, "must be larger than anchor.low");
}

// All fields except the scene, whose text a file of its own would have too.
static void fields(Fields& f, Preset& preset) {
  f("name", preset.name);
  f("modality", preset.modality);
  f.unlessMissing("anchor", preset.anchor);
}

const std::vector<Preset>& builtInPresets() {
  static const std::vector<Preset> all = [] {
    std::vector<Preset> read;
    for (const std::string& text : presetTexts()) {
      Result<Preset> preset = presetFromJson(text);
      assert(preset.ok());
      read.push_back(std::move(*preset));
    }
    return read;
  }();
  return all;
}

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Preset& preset : builtInPresets()) all.push_back(preset.name);
    return all;
  }();
  return names;
}

Result<Preset> presetFromJson(const std::string& text) {
  const auto parsed = parseJson(text);
  if (!parsed) return parsed.error();
  std::string problem;
  Fields f(JsonFields(*parsed, "", problem));
  Preset preset;
  fields(f, preset);
  const nlohmann::json* part = f.raw("scene");
  f.refuseOthers();
  if (preset.name.empty()) f.refuse("name", "must not be empty");
  if (!part) f.refuse("scene", "is missing");
  if (!problem.empty()) return Error{problem};
  Result<Scene> scene = sceneFromJson(part->dump());
  if (!scene) return Error{"scene: " + scene.message()};
  preset.scene = std::move(*scene);
  preset.scene.camera.reset();
  preset.scene.clip = {};
  return preset;
}

std::string presetToJson(const Preset& preset) {
  auto file = jsonOf(preset);
  auto scene = nlohmann::ordered_json::parse(sceneToJson(preset.scene));
  for (const char* view : {"camera", "clip"}) scene.erase(view);
  file["scene"] = std::move(scene);
  return file.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void moveValues(Scene& scene, double by) {
  for (CurvePoint& point : scene.transferFunction.points) point.value = float(point.value + by);
  if (scene.window) scene.window->centre += by;
}

Scene sceneOf(const Preset& preset, const Volume& volume) {
  Scene scene = preset.scene;
  if (preset.anchor)
    anchor(scene, *preset.anchor, usualRange(volume));
  else if (preset.modality == "CT")
    moveValues(scene, waterOf(volume));
  return scene;
}

bool sameLook(const Scene& a, const Scene& b) { return withLook(a, b) == a; }

Scene withLook(Scene scene, const Scene& look) {
  scene.mode = look.mode;
  scene.window = look.window;
  scene.transferFunction = look.transferFunction;
  scene.shading = look.shading;
  scene.lights = look.lights;
  scene.background = look.background;
  return scene;
}

Status checkPreset(const std::string& name, const std::vector<Preset>& own) {
  std::vector<std::string> names{"auto"};
  for (const auto* presets : {&builtInPresets(), &own})
    for (const Preset& preset : *presets) names.push_back(preset.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  const auto similar = similarName(name, names);
  return Error{"Unknown preset \"" + name.substr(0, 60) + "\"." +
               (similar ? " Did you mean " + *similar + "?" : "")};
}

Result<Scene> presetScene(const std::string& name, const Volume& volume, const std::vector<Preset>& own) {
  if (Status known = checkPreset(name, own); !known) return known.error();
  const bool automatic = name == "auto";
  const std::string wanted = automatic ? automaticPreset(volume) : name;
  const Preset* preset = found(builtInPresets(), wanted);
  if (!preset) preset = found(own, wanted);
  Scene scene = sceneOf(*preset, volume);
  if (automatic) scene.lights = shoulderLights();
  return scene;
}

}  // namespace volumen
