#include "viewer/plan/cost_model.h"
#include "viewer/plan/rule_lines.h"

namespace volumen {

Resampler resamplerOf(const RenderOptions& o) {
  return o.resampler.value_or(o.method == Method::gpu ? Resampler::gl : Resampler::cpu);
}

namespace {

// Returns the addition for a level that this path does not keep.
std::string unlessPromised(const RenderOptions& o) {
  return o.step || keepsLevels(o) ? "" : "; its steps do not see what lies between, so no error is promised";
}

}  // namespace

Effect decideMethod(const RuleInput& in, Plan& plan) {
  plan.method = in.options.method;
  switch (plan.method) {
    case Method::blend:
      return on("blend, as asked: slices from the back to the front, each shaded, then blended" +
                unlessPromised(in.options));
    case Method::preshaded:
      return on(
          "preshaded, as asked: colours of voxels are interpolated, not values, which is wrong where the "
          "curve is not straight");
    case Method::gpu:
      return on("gpu, as asked: everything in one shader of OpenGL" + unlessPromised(in.options));
    case Method::reference:
    case Method::planes:
      break;
  }
  return on(composite(in) ? "planes: rays from front to back, so that what is hidden is never shaded"
                          : "planes: rays from front to back, each looked at from end to end");
}

// Compares only with blend, which draws the same picture; other methods draw another one. Savings of
// projections are not predicted.
std::string methodCost(const RuleInput& in, const Plan& plan) {
  if (!composite(in) || plan.method != Method::planes || plan.resampler != Resampler::cpu) return {};
  RenderOptions options = in.options;
  options.method = Method::blend;
  options.tolerance.reset();
  const auto blend = makePlan(in.scene, in.facts, options);
  if (!blend) return {};
  const double share = predictedCost(plan, in.facts).ns() / predictedCost(*blend, in.facts).ns();
  return share < 1 ? "; predicted " + inDigits(share, 2) + " of the time of blend" : "";
}

Effect decideResampler(const RuleInput& in, Plan& plan) {
  plan.resampler = resamplerOf(in.options);
  if (plan.resampler == Resampler::cpu)
    return on(
        plan.method == Method::planes && composite(in)
            ? "cpu: can pass over empty blocks, stops where a ray is opaque, and draws the same on every "
              "machine"
            : "cpu: draws the same on every machine");
  if (plan.method == Method::preshaded) return on("gl, as asked: colours are interpolated in floats");
  const std::string by =
      plan.bits == 16 ? "filtered by the texture hardware" : "interpolated in floats as on the CPU";
  if (plan.method == Method::gpu) return on("gl: " + by);
  return on("gl, as asked: " + by + (plan.bits == 16 ? ", while the CPU shades" : ", while that shades") +
            (plan.method == Method::planes ? unlessPromised(in.options) : ""));
}

Effect decideBlending(const RuleInput& in, Plan& plan) {
  plan.blending = Blending::floats;
  if (plan.method != Method::blend) return off("rays are composited one by one, in floats");
  plan.blending = in.options.blending.value_or(Blending::floats);
  switch (plan.blending) {
    case Blending::bits8:
      return on(
          "8 bits, as asked: up to half of 1/255 is rounded off after each slice, and what is above 1 cut "
          "off");
    case Blending::bits16:
      return on(
          "16 bits, as asked: up to half of 1/65535 is rounded off after each slice, and what is above 1 cut "
          "off");
    case Blending::floats:
      break;
  }
  return on("floats: nothing is rounded off that could be seen");
}

}  // namespace volumen
