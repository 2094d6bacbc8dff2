#pragma once

#include <functional>

#include "viewer/gl/gl_state.h"
#include "viewer/gl/ray_band.h"
#include "viewer/methods/render_caches.h"
#include "viewer/methods/render_inputs.h"
#include "viewer/methods/rendered.h"

namespace volumen {

/// Draws a picture with the caches' OpenGL, with its context current. Returns an Error if there is no OpenGL,
/// or that of `draw`.
Result<Rendered> onGl(RenderCaches& caches, const std::function<Status(GlState& gl, Rendered& done)>& draw);

/// Returns the Error for an OpenGL failure without a known reason.
Error glFailed();

/// Loads density and gradients as the plan needs them. Adds their bytes and the time to `stats`.
Status loadTextures(const Plan& plan, RenderCaches& caches, GlState& gl, const CancelToken& cancel,
                    RenderStats& stats);

/// Writes a band's pixels, four floats each. Composites: premultiplied colour and alpha. Extremes: the
/// density. Averages: sums of density times length, and lengths (0: the mean itself). Returns glFailed() if
/// `rgba` is empty.
Status writeBand(const Plan& plan, const RenderInputs& inputs, const RayBand& band,
                 const std::vector<float>& rgba, Picture& picture);

}  // namespace volumen
