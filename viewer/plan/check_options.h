#pragma once

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Refuses options out of range and those that do not go together or with the scene: a sentence that names
/// them.
Status checkOptions(const Scene& scene, const RenderOptions& options);

}  // namespace volumen
