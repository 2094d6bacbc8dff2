#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Renders by blending with OpenGL as in the paper (3.2). The texture hardware resamples a slice and returns
/// it, the CPU shades it, and the frame buffer blends it. Meanwhile the next slice is drawn.
Result<Rendered> renderBlendGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
