#include "viewer/methods/gl_band.h"

#include "viewer/methods/caches.h"
#include "viewer/volume/clock.h"

namespace volumen {

Result<Rendered> onGl(RenderCaches& caches, const std::function<Status(GlState& gl, Rendered& done)>& draw) {
  const auto made = caches.impl().glState();
  if (!made) return made.error();
  GlState& gl = **made;
  const CurrentContext current(*gl.context);
  if (!current) return Error{"The OpenGL context cannot be used on this thread; use --resampler cpu."};
  Rendered done;
  if (Status s = draw(gl, done); !s) return s.error();
  done.stats.kernel = gl.renderer;
  return done;
}

Error glFailed() { return Error{"OpenGL failed while it drew; use --resampler cpu."}; }

Status loadTextures(const Plan& plan, RenderCaches& caches, GlState& gl, const CancelToken& cancel,
                    RenderStats& stats) {
  const double begin = wallMs();
  if (Status s = gl.textures.load(plan, *caches.impl().voxels, cancel); !s) return s;
  stats.gradientsMs += wallMs() - begin;
  stats.densityBytes += gl.textures.densityBytes();
  if (plan.gradients) stats.gradientBytes += gl.textures.gradientBytes();
  return {};
}

Status writeBand(const Plan& plan, const RenderInputs& inputs, const RayBand& band,
                 const std::vector<float>& rgba, Picture& picture) {
  if (rgba.empty()) return glFailed();
  const Mode mode = plan.scene.mode;
  std::vector<float> values(std::size_t(4) * band.stride);
  const TraceRow row = traceRowOf(values);
  const float* pixel = rgba.data();
  for (const RayRow& rays : band.rows) {
    for (int n = 0; n < band.stride; ++n, pixel += 4) {
      const bool sum = mode == Mode::average && pixel[1] > 0;
      row.red[n] = sum ? pixel[0] / pixel[1] : pixel[0];
      row.green[n] = pixel[1], row.blue[n] = pixel[2], row.alpha[n] = pixel[3];
    }
    if (mode == Mode::composite) {
      writePixels(plan.scene.background, rays, row, picture);
    } else {
      writeProjectedPixels(plan.scene, inputs.scale(), rays, row.red, picture);
      roundPixels(plan.blending, rays, picture);
    }
  }
  return {};
}

}  // namespace volumen
