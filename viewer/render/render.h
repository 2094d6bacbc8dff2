#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the plan with nothing left open: makePlan() with the result of a pilot (probe). It depends only on
/// the picture, not on the machine. Adds to the times of `stats`. Errors are those of render().
Result<Plan> completedPlan(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                           const CancelToken& cancel = {});

/// Draws the completed plan. The Error means cancelled ("cancelled"), or names a missing resource in a
/// sentence.
Result<Rendered> render(const Plan& plan, RenderCaches& caches, const CancelToken& cancel = {});

}  // namespace volumen
