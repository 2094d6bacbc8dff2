#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The plan with nothing left open: makePlan() with what a pilot (probe) finds. What comes of it depends on
/// the picture alone, not on the machine. Adds to the times of `stats`. Errors as render().
Result<Plan> completedPlan(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                           const CancelToken& cancel = {});

/// Draws the plan, completed. An Error where it was cancelled ("cancelled") or a resource is missing (a
/// sentence).
Result<Rendered> render(const Plan& plan, RenderCaches& caches, const CancelToken& cancel = {});

}  // namespace volumen
