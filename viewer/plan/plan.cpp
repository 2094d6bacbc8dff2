#include "viewer/plan/plan.h"

#include "viewer/plan/check_options.h"
#include "viewer/plan/default_window.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/scene/first_camera.h"
#include "viewer/scene/modes.h"

namespace volumen {

namespace {

// Records changes made to the volume before drawing.
void sayWhatWasDone(const VolumeFacts& facts, Plan& plan) {
  plan.cut = facts.cut;
  if (const std::string text = cutText(facts.cut); !text.empty())
    plan.effects.push_back({"cut", true, false, text + "; what is cut away is taken as air"});
}

// Returns the scene with all settings that picture.md 8 makes optional: camera, window, gradientFloor.
Scene completed(Scene scene, const VolumeFacts& facts, glm::ivec2 size) {
  if (!scene.camera)
    scene.camera = fitCamera(firstCamera(facts.geometry), facts.geometry, double(size.x) / size.y);
  else if (!scene.camera->target)
    scene.camera->target = facts.geometry.centre();
  if (!scene.window) scene.window = defaultWindow(facts);
  if (!scene.shading.gradientFloor) scene.shading.gradientFloor = defaultGradientFloor(facts);
  return scene;
}

std::string referenceReason(const Scene& scene, const RenderOptions& options) {
  const std::string what = "everything, adaptively, cell by cell, in double precision";
  if (options.method == Method::reference) return what;
  return "mode " + std::string(modeName(scene.mode)) + " has no faster method: " + what;
}

}  // namespace

Result<Plan> makePlan(const Scene& scene, const VolumeFacts& facts, const RenderOptions& options,
                      const std::optional<PilotFinding>& pilot) {
  if (Status s = checkOptions(scene, options); !s) return s.error();
  Plan plan;
  plan.scene = completed(scene, facts, options.size);
  plan.curve = plan.scene.transferFunction;
  plan.options = options;
  if (methodOf(scene, options) == Method::reference) {
    plan.method = Method::reference;
    plan.effects.push_back({"reference", true, false, referenceReason(scene, options)});
    sayWhatWasDone(facts, plan);
    return plan;
  }
  const RuleInput input{plan.scene, facts, options, pilot};
  for (const Rule& rule : rules()) {
    Effect effect = rule.decide(input, plan);
    effect.name = rule.name;
    effect.sound = rule.sound;
    plan.effects.push_back(std::move(effect));
  }
  for (std::size_t n = 0; n < plan.effects.size(); ++n)
    if (rules()[n].cost) plan.effects[n].reason += rules()[n].cost(input, plan);
  sayWhatWasDone(facts, plan);
  plan.pilot = pilot;
  if (!pilot) plan.pilotSteps = openSteps(input, plan);
  return plan;
}

}  // namespace volumen
