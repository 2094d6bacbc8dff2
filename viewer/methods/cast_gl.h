#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Renders the GPU method (figure 1c of the paper), all in one OpenGL shader. Also preshaded with OpenGL
/// (figure 1b): voxels shaded on the CPU, then resampled and composited by OpenGL.
Result<Rendered> renderCastGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
