#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/render_inputs.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Renders in the traditional order (figure 1b of the paper; Van Gelder and Kim). Voxels are classified and
/// shaded first, then colours and opacities are interpolated and composited front to back (picture.md 9). The
/// interpolated quantities are the opacity per unit distance and the colour times it, so that invisible
/// voxels contribute no colour. Each picture shades all voxels again.
Result<Rendered> renderPreshaded(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

/// Returns the shaded voxels of a picture, four floats each: colour times opacity, and opacity per unit
/// distance.
Buffer<float> shadeVoxels(const Plan& plan, const RenderInputs& inputs, const VoxelGeometry& geometry,
                          const CancelToken& cancel);

}  // namespace volumen
