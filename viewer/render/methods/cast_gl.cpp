#include "viewer/render/methods/cast_gl.h"

#include "viewer/render/caches.h"
#include "viewer/render/methods/frame_row.h"
#include "viewer/render/methods/preshaded.h"
#include "viewer/render/methods/row_painter.h"
#include "viewer/render/methods/ticks.h"

namespace volumen {

namespace {

// What the plan's program reads: the volume, or its voxels shaded.
Status loadVolume(const Plan& plan, const PlanesFrame& frame, RenderCaches& caches, GlState& gl,
                  const CancelToken& cancel, RenderStats& stats) {
  const double begin = nowMs();
  Status loaded;
  if (plan.method == Method::preshaded) {
    const VoxelGeometry& geometry = caches.volume()->geometry();
    const Buffer<float> shaded = shadeVoxels(plan, frame, geometry, cancel);
    if (cancel.cancelled()) return Error{"cancelled"};
    loaded = gl.textures.loadShaded(geometry.size, shaded.data(), cancel);
    stats.shadeMs = nowMs() - begin;
    stats.shaded = plan.lit ? geometry.voxelCount() : 0;
    return loaded;
  }
  loaded = gl.textures.load(plan, caches, cancel);
  stats.gradientsMs += nowMs() - begin;
  stats.densityBytes += gl.textures.densityBytes();
  if (plan.gradients) stats.gradientBytes += gl.textures.gradientBytes();
  return loaded;
}

void writeBand(const Plan& plan, const PlanesFrame& frame, const RayBand& band,
               const std::vector<float>& rgba, Picture& picture) {
  std::vector<float> values(std::size_t(4) * band.stride);
  const TraceRow row = FrameRow::rowOf(values);
  const float* pixel = rgba.data();
  for (const RayRow& rays : band.rows) {
    for (int n = 0; n < band.stride; ++n, pixel += 4) {
      row.red[n] = pixel[0], row.green[n] = pixel[1];
      row.blue[n] = pixel[2], row.alpha[n] = pixel[3];
    }
    if (plan.scene.mode == Mode::composite)
      writePixels(plan.scene.background, rays, row, picture);
    else
      writeProjectedPixels(plan.scene, frame.scale(), rays, row.red, picture);
  }
}

}  // namespace

Result<Rendered> renderCastGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  const auto made = caches.impl().glState();
  if (!made) return made.error();
  GlState& gl = **made;
  const CurrentContext current(*gl.context);
  if (!current) return Error{"The OpenGL context cannot be used on this thread; use --resampler cpu."};

  Rendered done;
  RenderStats& stats = done.stats;
  const PlanesFrame frame(plan, caches, stats);
  if (Status s = loadVolume(plan, frame, caches, gl, cancel, stats); !s) return s.error();
  const double begin = nowMs();
  const RaySetup setup(plan.scene, caches.volume()->geometry(), plan.options.size, plan.stepVoxels,
                       plan.clip);
  if (Status s = gl.caster.prepare(plan, frame.trace(), gl.textures); !s) return s.error();
  preparePicture(plan, done.picture);
  RayBands bands(setup, plan.options.size, mostSteps(caches.volume()->size(), plan.stepVoxels));
  RayBand band;
  for (bands.fill(band, plan.options.threads); !band.empty(); bands.fill(band, plan.options.threads)) {
    const std::vector<float>& pixels = gl.caster.draw(band, frame.trace().inverseUnitMm);
    if (pixels.empty()) return Error{"OpenGL failed while it drew; use --resampler cpu."};
    writeBand(plan, frame, band, pixels, done.picture);
    if (cancel.cancelled()) return Error{"cancelled"};
  }
  stats.resampleMs = stats.glMs = nowMs() - begin;
  stats.kernel = gl.renderer;
  return done;
}

}  // namespace volumen
