#pragma once

#include "viewer/render/render.h"

namespace volumen {

/// What a pilot finds of a plan that leaves plain steps open (Plan::pilotSteps): about a hundredth of its
/// rays are followed by them and cell by cell, finely: by the first steps, then by those that their errors
/// tell to be as long as may be, or by up to two shorter ones that save time. The longest that keep the
/// level's promise at worst, with what may have been missed, are found. Adds to the times of `stats`. An
/// Error where it was cancelled; out of memory it throws.
Result<PilotFinding> probe(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                           const CancelToken& cancel);

}  // namespace volumen
