#pragma once

#include "viewer/render/render.h"

namespace volumen {

/// Algorithm 1 of the paper (3.1): each picture row is a plane of rays, resampled, then shaded and composited
/// front to back. The CPU takes blocks of pixels, so that rays that are near each other are resampled
/// together.
Result<Rendered> renderPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
