#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// Measured cost of an effect in one picture. It is kept apart from the plan, which is a pure function and
/// knows no times.
struct EffectCost {
  double ms = 0;           ///< Share of the picture's wall clock; negative if the effect saves time
  bool estimated = false;  ///< True if a stage's measured time was divided by sample counts
  double onceMs = 0;       ///< Measured time for data made for this picture and kept for the next
  bool operator==(const EffectCost&) const = default;
};

/// One entry per effect of the plan, in order; empty if its time cannot be separated.
using EffectCosts = std::vector<std::optional<EffectCost>>;

/// Returns for example "12 ms", "about 3.1 ms", "saves up to about 40 ms", or "about 3.1 ms, once 210 ms".
std::string costText(const EffectCost& cost);

/// Returns the plan as --explain prints it after drawing: "on   gradients: the scene is lit (about 3.1 ms)".
std::string explain(const Plan& plan, const EffectCosts& costs);
/// Returns the same as JSON for --stats: costMs (null if unknown), costEstimated, onceMs.
std::string explainJson(const Plan& plan, const EffectCosts& costs);

}  // namespace volumen
