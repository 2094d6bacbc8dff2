#pragma once

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns the method that draws the scene: the requested one, but the reference for modes without kernels.
Method methodOf(const Scene& scene, const RenderOptions& options);

/// Returns whether a level can integrate along intervals (if no step is requested). Only planes on the CPU
/// know the values around an interval before they draw it.
bool canIntegrate(const Scene& scene, const RenderOptions& options);

/// Returns an Error that names the options if any is out of range, or if they conflict with each other or the
/// scene.
Status checkOptions(const Scene& scene, const RenderOptions& options);

}  // namespace volumen
