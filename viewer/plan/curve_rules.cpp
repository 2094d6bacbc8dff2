// Choices that change the drawn curve.
#include <cmath>

#include "viewer/plan/rule_lines.h"
#include "viewer/scene/curve_changes.h"
#include "viewer/scene/step_length.h"

namespace volumen {

namespace {

constexpr const char* noCurve = "a projection of values has no curve";

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
  // Solves 1 - (1 - a)^(step / unit) = threshold for a.
  const double threshold = *in.options.opacityThreshold;
  const double a = -std::expm1(std::log1p(-threshold) * plan.curve.unitDistance /
                               stepMm(*in.scene.camera, in.facts.geometry, plan.stepVoxels));
  plan.curve = withoutFaint(plan.curve, a);
  return on("samples of opacity below " + inDigits(threshold) + " are passed over, as asked (" + inDigits(a) +
            " per unit distance)");
}

}  // namespace volumen
