#pragma once

#include "viewer/render/render.h"

namespace volumen {

/// Runs the pilot of a plan that leaves plain steps open (Plan::pilotSteps). A few of its rays in a thousand
/// are followed finely cell by cell, and by plain steps: the first length, then the longest that its errors
/// suggest, or up to two shorter ones that still save time. If none is kept for want of rays, all of its rays
/// are followed, two or four times as many. A draft tries two lengths, and keeps one if means over blocks of
/// pixels do. Returns the longest steps that keep the level's promise in the worst case, allowing for
/// missed pixels. Adds to the times of `stats`. The Error means
/// cancelled; throws if memory runs out.
Result<PilotFinding> probe(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                           const CancelToken& cancel);

}  // namespace volumen
