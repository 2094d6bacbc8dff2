#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Renders by algorithm 1 of the paper (3.1): each picture row is a plane of rays, which is resampled, then
/// shaded and composited front to back. On the CPU also by algorithm 2 (3.2): slices parallel to the picture,
/// blended back to front. The CPU takes blocks of pixels, and a few slices at a time, so that neighbouring
/// samples are resampled together.
Result<Rendered> renderPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
