#include "viewer/methods/cast_gl.h"

#include "viewer/methods/gl_band.h"
#include "viewer/methods/preshaded.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

// Shades the voxels and uploads them.
Status loadShaded(const Plan& plan, const RenderInputs& inputs, const VoxelGeometry& geometry, GlState& gl,
                  const CancelToken& cancel, RenderStats& stats) {
  const double begin = wallMs();
  const Buffer<float> shaded = shadeVoxels(plan, inputs, geometry, cancel);
  if (cancel.cancelled()) return Error{"cancelled"};
  const Status loaded = gl.textures.loadShaded(geometry.size, shaded.data(), cancel);
  stats.shadeMs = wallMs() - begin;
  stats.shaded = plan.lit ? geometry.voxelCount() : 0;
  return loaded;
}

Status drawCast(const Plan& plan, RenderCaches& caches, const CancelToken& cancel, GlState& gl,
                Rendered& done) {
  RenderStats& stats = done.stats;
  const VoxelGeometry& geometry = caches.volume()->geometry();
  const RenderInputs inputs(plan, caches, stats);
  const Status loaded = plan.method == Method::preshaded
                            ? loadShaded(plan, inputs, geometry, gl, cancel, stats)
                            : loadTextures(plan, caches, gl, cancel, stats);
  if (!loaded) return loaded;
  const double begin = wallMs();
  const RayGenerator setup(plan, geometry);
  if (Status s = gl.caster.prepare(plan, inputs.trace(), gl.textures); !s) return s;
  preparePicture(plan, done.picture);
  RayBands bands(setup, plan.options.size, mostSteps(geometry.size, plan.stepVoxels));
  RayBand band;
  for (bands.fill(band, plan.options.threads); !band.empty(); bands.fill(band, plan.options.threads)) {
    if (Status s = gl.caster.draw(band, inputs.trace().inverseUnitMm); !s) return s;
    if (Status s = writeBand(plan, inputs, band, gl.caster.pixels(), done.picture); !s) return s;
    if (cancel.cancelled()) return Error{"cancelled"};
  }
  stats.resampleMs = stats.glMs = wallMs() - begin;
  return {};
}

}  // namespace

Result<Rendered> renderCastGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  return onGl(caches, [&](GlState& gl, Rendered& done) { return drawCast(plan, caches, cancel, gl, done); });
}

}  // namespace volumen
