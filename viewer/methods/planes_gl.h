#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Renders planes with OpenGL as the resampler (paper 3.1). The calling thread feeds OpenGL. While OpenGL
/// draws one batch of rays and reads back the one before, all cores shade the one before that.
Result<Rendered> renderPlanesGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
