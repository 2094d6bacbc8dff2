#pragma once

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The method that draws the scene: as asked, but the reference for a mode without kernels.
Method methodOf(const Scene& scene, const RenderOptions& options);

/// Whether a level can integrate along intervals, where no step is asked for. Only the CPU's planes know the
/// values around an interval before they draw it.
bool canIntegrate(const Scene& scene, const RenderOptions& options);

/// Refuses options out of range and those that do not go together or with the scene: a sentence that names
/// them.
Status checkOptions(const Scene& scene, const RenderOptions& options);

}  // namespace volumen
