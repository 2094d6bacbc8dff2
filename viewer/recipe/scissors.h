#pragma once

#include <string>

#include "viewer/recipe/step_kinds.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Returns the step that cuts a lasso out of a segment, within `withinMm` of its origin along the line of
/// sight (leftBy()).
Step scissorsStep(const std::string& segment, const Lasso& lasso, double withinMm);

/// Runs such a step. The Error means: its points are not an outline and a line of sight.
Result<BitMask> leftByScissors(const StepInput& in);

}  // namespace volumen
