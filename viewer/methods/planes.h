#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Algorithm 1 of the paper (3.1): each picture row is a plane of rays, resampled, then shaded and composited
/// front to back. By the CPU also algorithm 2 (3.2): slices parallel to the picture, blended back to front.
/// The CPU takes blocks of pixels, and of slices a few at a time, so that samples that are near each other
/// are resampled together.
Result<Rendered> renderPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
