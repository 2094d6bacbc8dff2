#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Blend with OpenGL as the paper has it (3.2): the texture hardware resamples a slice and brings it back,
/// the CPU shades it, and the frame buffer blends it. The next slice is drawn meanwhile.
Result<Rendered> renderBlendGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
