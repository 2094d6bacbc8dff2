// The choices that change the curve which is drawn.
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/plan/rule_lines.h"
#include "viewer/scene/curve_changes.h"

namespace volumen {

namespace {

constexpr const char* noCurve = "a projection of values has no curve";

// SCENE 9: the length of a step on a ray along the camera's axis, mm.
double stepMm(const RuleInput& in, double stepVoxels) {
  const glm::dvec3 axis = glm::normalize(in.scene.camera->direction);
  return stepVoxels / glm::length(in.facts.geometry.voxelFromPatientStep() * axis);
}

}  // namespace

Effect decideCurveTable(const RuleInput& in, Plan& plan) {
  if (in.scene.mode != Mode::composite) return off(noCurve);
  if (!in.options.curveTable) return off("the curve is followed exactly, point by point");
  plan.curve = tabulated(plan.curve, *in.options.curveTable, in.facts.range);
  return on("the nearest of " + std::to_string(*in.options.curveTable) +
            " entries over the volume's values, as asked");
}

Effect decideFaintSamples(const RuleInput& in, Plan& plan) {
  if (in.scene.mode != Mode::composite) return off(noCurve);
  if (!in.options.opacityThreshold) return off("every sample that has any opacity counts");
  // 1 - (1 - a)^(step / unit) = threshold, solved for a.
  const double threshold = *in.options.opacityThreshold;
  const double a =
      -std::expm1(std::log1p(-threshold) * plan.curve.unitDistance / stepMm(in, plan.stepVoxels));
  plan.curve = withoutFaint(plan.curve, a);
  return on("samples of opacity below " + inDigits(threshold) + " are passed over, as asked (" + inDigits(a) +
            " per unit distance)");
}

}  // namespace volumen
