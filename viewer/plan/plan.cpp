#include "viewer/plan/plan.h"

#include "viewer/plan/rules.h"

namespace volumen {

namespace {

// The scene with everything set that SCENE 8 lets out: camera, window, gradientFloor.
Scene completed(Scene scene, const VolumeFacts& facts, glm::ivec2 size) {
  if (!scene.camera)
    scene.camera = fitCamera(Camera{}, facts.geometry, double(size.x) / size.y);
  else if (!scene.camera->target)
    scene.camera->target = facts.geometry.centre();
  if (!scene.window) {
    const double width = facts.p999 - facts.p01;
    scene.window = facts.fileWindow
                       ? *facts.fileWindow
                       : Window{.centre = (facts.p01 + facts.p999) / 2, .width = width > 0 ? width : 1};
  }
  if (!scene.shading.gradientFloor) scene.shading.gradientFloor = defaultGradientFloor(facts);
  return scene;
}

Status checkOptions(const Scene& scene, const RenderOptions& o) {
  if (o.size.x < 1 || o.size.y < 1 || o.size.x > 32768 || o.size.y > 32768)
    return Error{"--size must be 1x1 .. 32768x32768."};
  if (o.step && !(*o.step >= 1.0 / 1024 && *o.step <= 64))
    return Error{"--step must be 1/1024 .. 64 voxels."};
  if (o.precision && *o.precision != 16 && *o.precision != 32) return Error{"--precision must be 16 or 32."};
  if (o.mapSize && (*o.mapSize < 2 || *o.mapSize > 1024)) return Error{"--map-size must be 2 .. 1024."};
  if (o.threads < 0 || o.threads > 1024) return Error{"--threads must be 1 .. 1024."};
  if (o.resampler == Resampler::gl && o.method == Method::reference)
    return Error{
        "--resampler gl does not go with --method reference, which interpolates in double precision."};
  if (o.shader == Shader::map && scene.shading.localViewer)
    return Error{
        "--shader map cannot draw shading.localViewer: the viewer's direction changes from ray to ray; use "
        "--shader phong."};
  return {};
}

}  // namespace

Result<Plan> makePlan(const Scene& scene, const VolumeFacts& facts, const RenderOptions& options) {
  if (Status s = checkOptions(scene, options); !s) return s.error();
  Plan plan;
  plan.scene = completed(scene, facts, options.size);
  plan.options = options;
  plan.method = options.method;
  if (plan.method == Method::reference) {
    plan.effects.push_back({"reference", true, false, "everything, adaptively, cell by cell, in double precision"});
    return plan;
  }
  const RuleInput input{plan.scene, facts, options};
  for (const Rule& rule : rules()) {
    Effect effect = rule.decide(input, plan);
    effect.name = rule.name;
    effect.sound = rule.sound;
    plan.effects.push_back(std::move(effect));
  }
  return plan;
}

}  // namespace volumen
