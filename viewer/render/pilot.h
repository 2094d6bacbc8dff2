#pragma once

#include "viewer/render/render.h"

namespace volumen {

/// settled() of a plan that leaves something open; out of memory it throws.
Result<Plan> sendPilot(const Plan& plan, RenderCaches& caches, RenderStats& stats, const CancelToken& cancel);

}  // namespace volumen
