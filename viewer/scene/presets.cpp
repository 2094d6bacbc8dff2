#include "viewer/scene/presets.h"

#include <algorithm>
#include <cassert>

#include "viewer/scene/automatic.h"
#include "viewer/scene/json_fields.h"
#include "viewer/scene/preset_texts.h"
#include "viewer/scene/scene_json.h"
#include "viewer/scene/similar_name.h"

namespace volumen {

namespace {

struct Preset {
  std::string name;
  Scene scene;
  std::optional<ValueRange> anchor;
};

// A preset file: {"name", "modality", "scene": what differs from SCENE 8's defaults, "anchor"?}. The values
// of MR have no unit; a preset with an anchor is moved so that `low` falls on the volume's P1 and `high` on
// its P99.5.
Preset readPreset(const std::string& text) {
  const auto json = parseJson(text);
  assert(json.ok());
  std::string problem;
  JsonFields fields(*json, "", problem);
  Preset preset;
  std::string modality;
  fields.read("name", preset.name);
  fields.read("modality", modality);
  if (auto anchor = fields.object("anchor")) {
    anchor->read("low", preset.anchor.emplace().low);
    anchor->read("high", preset.anchor->high);
    anchor->refuseOthers();
  }
  const nlohmann::json* part = fields.raw("scene");
  fields.refuseOthers();
  assert(problem.empty() && part);
  const auto scene = sceneFromJson(part->dump());
  assert(scene.ok());
  preset.scene = *scene;
  return preset;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = [] {
    std::vector<Preset> read;
    for (const std::string& text : presetTexts()) read.push_back(readPreset(text));
    return read;
  }();
  return all;
}

void anchor(Scene& scene, ValueRange from, ValueRange to) {
  // A volume of one value has no range to map to; that value then counts as `high`.
  const double scale = to.high > to.low ? (to.high - to.low) / (from.high - from.low) : 1;
  const auto moved = [&](double value) { return to.high + (value - from.high) * scale; };
  for (CurvePoint& p : scene.transferFunction.points) p.value = float(moved(double(p.value)));
  for (GradientOpacityPoint& p : scene.transferFunction.gradientOpacity) p.gradient *= scale;
  if (scene.window) scene.window = Window{moved(scene.window->centre), scene.window->width * scale};
}

// Over the left shoulder, and a weak light from the other side, so that no part is black.
std::vector<Light> shoulderLights() {
  return {{.direction = {-0.5, 0.5, 1}}, {.direction = {0.8, -0.3, 0.6}, .intensity = 0.25}};
}

}  // namespace

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Preset& preset : presets()) all.push_back(preset.name);
    return all;
  }();
  return names;
}

Status checkPreset(const std::string& name) {
  std::vector<std::string> names = presetNames();
  names.push_back("auto");
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  const auto similar = similarName(name, names);
  return Error{"Unknown preset \"" + name.substr(0, 60) + "\"." +
               (similar ? " Did you mean " + *similar + "?" : "")};
}

Result<Scene> presetScene(const std::string& name, const Volume& volume) {
  if (Status known = checkPreset(name); !known) return known.error();
  const bool automatic = name == "auto";
  const std::string wanted = automatic ? automaticPreset(volume) : name;
  const auto found = std::find_if(presets().begin(), presets().end(),
                                  [&](const Preset& preset) { return preset.name == wanted; });
  Scene scene = found->scene;
  if (found->anchor) anchor(scene, *found->anchor, usualRange(volume));
  if (automatic) scene.lights = shoulderLights();
  return scene;
}

}  // namespace volumen
