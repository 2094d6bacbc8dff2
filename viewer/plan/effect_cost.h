#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// What an effect cost one picture that was drawn. A plan is a pure function and knows no times: they are put
/// beside it.
struct EffectCost {
  double ms = 0;           ///< of the picture's wall clock; below 0: saved
  bool estimated = false;  ///< a stage's measured time, divided by counts of samples
  double onceMs = 0;       ///< measured: what was made for this picture and is kept for the next
  bool operator==(const EffectCost&) const = default;
};

/// One an effect of the plan, in its order; none where no time can be told apart as its own.
using EffectCosts = std::vector<std::optional<EffectCost>>;

/// "12 ms", "about 3.1 ms", "saves up to about 40 ms", "about 3.1 ms, once 210 ms".
std::string costText(const EffectCost& cost);

/// The plan as --explain prints it once a picture was drawn: "on   gradients: the scene is lit (about 3.1
/// ms)".
std::string explain(const Plan& plan, const EffectCosts& costs);
/// The same as JSON, for --stats: costMs (null: not known), costEstimated, onceMs.
std::string explainJson(const Plan& plan, const EffectCosts& costs);

}  // namespace volumen
