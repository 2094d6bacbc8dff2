#include "viewer/plan/rule_lines.h"

namespace volumen {

Effect decideMethod(const RuleInput& in, Plan& plan) {
  plan.method = in.options.method;
  switch (plan.method) {
    case Method::blend:
      return on("blend, as asked: slices from the back to the front, each shaded, then blended");
    case Method::reference:
    case Method::planes:
      break;
  }
  return on("planes: rays from front to back, so that what is hidden is never shaded");
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
