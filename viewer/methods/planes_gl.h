#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Planes with OpenGL as the resampler (paper 3.1). One master, the calling thread, feeds OpenGL; while that
/// draws one batch of rays and brings the one before back, all cores shade the one before that.
Result<Rendered> renderPlanesGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
