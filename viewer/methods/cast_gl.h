#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// GPU (figure 1c of the paper): everything in one shader of OpenGL. Preshaded with OpenGL (figure 1b):
/// voxels shaded on the CPU, resampled and composited by OpenGL.
Result<Rendered> renderCastGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

}  // namespace volumen
