#pragma once

#include "viewer/plan/effect_cost.h"
#include "viewer/render/render.h"

namespace volumen {

/// What each effect of a plan cost the picture that `stats` tells of. What is off cost nothing. The picture,
/// its resampling and what was made once are measured; what a sample's light, gradient and colour share in
/// the measured time of shading is divided by counts of samples and lights, and says that it is estimated.
EffectCosts effectCosts(const Plan& plan, const RenderStats& stats);

}  // namespace volumen
