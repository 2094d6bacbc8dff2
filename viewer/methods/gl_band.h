#pragma once

#include <functional>

#include "viewer/gl/gl_state.h"
#include "viewer/gl/ray_band.h"
#include "viewer/methods/render_caches.h"
#include "viewer/methods/render_inputs.h"
#include "viewer/methods/rendered.h"

namespace volumen {

/// Draws a picture with the caches' OpenGL, its context current meanwhile. An Error where there is no OpenGL,
/// or `draw`'s.
Result<Rendered> onGl(RenderCaches& caches, const std::function<Status(GlState& gl, Rendered& done)>& draw);

/// What is to be said where OpenGL failed without saying why.
Error glFailed();

/// Loads density and gradients as the plan needs them, and counts their bytes and the time.
Status loadTextures(const Plan& plan, RenderCaches& caches, GlState& gl, const CancelToken& cancel,
                    RenderStats& stats);

/// Writes a band's pixels, four floats each: premultiplied colour and alpha; the density of a projection; of
/// an average, densities times lengths and lengths (0: the mean itself). glFailed() where there are none.
Status writeBand(const Plan& plan, const RenderInputs& inputs, const RayBand& band,
                 const std::vector<float>& rgba, Picture& picture);

}  // namespace volumen
