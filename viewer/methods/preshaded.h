#pragma once

#include "viewer/methods/render_caches.h"
#include "viewer/methods/render_inputs.h"
#include "viewer/methods/rendered.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The traditional order of operations (figure 1b of the paper; Van Gelder and Kim): voxels are classified
/// and shaded first, then colours and opacities are interpolated and composited front to back (picture.md 9).
/// What is interpolated is the opacity per unit distance and the colour times it, so that the colour of
/// invisible voxels counts for nothing. Everything is shaded again for each picture.
Result<Rendered> renderPreshaded(const Plan& plan, RenderCaches& caches, const CancelToken& cancel);

/// The shaded voxels of a picture, four floats each: colour times opacity, opacity per unit distance.
Buffer<float> shadeVoxels(const Plan& plan, const RenderInputs& inputs, const VoxelGeometry& geometry,
                          const CancelToken& cancel);

}  // namespace volumen
