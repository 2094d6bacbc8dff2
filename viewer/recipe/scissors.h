#pragma once

#include <string>

#include "viewer/recipe/step_kinds.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// The step that takes from a segment what a lasso cuts away, within so many mm of its origin along the line
/// of sight (leftBy()).
Step scissorsStep(const std::string& segment, const Lasso& lasso, double withinMm);

/// What such a step leaves of its segment. The Error: its places are no outline and no line of sight.
Result<BitMask> leftByScissors(const StepInput& in);

}  // namespace volumen
