#pragma once

#include "viewer/plan/effect_cost.h"
#include "viewer/render/render.h"

namespace volumen {

/// Returns the cost of each effect of a plan in the picture that `stats` describes; effects that are off cost
/// nothing. The picture, its resampling and one-time data are measured. The shares of light, gradients and
/// colour in the measured shading time are estimated from counts of samples and lights, and marked so.
EffectCosts effectCosts(const Plan& plan, const RenderStats& stats);

}  // namespace volumen
