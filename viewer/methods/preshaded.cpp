#include "viewer/methods/preshaded.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/kernels/preshaded.h"
#include "viewer/kernels/ray_generator.h"
#include "viewer/kernels/shade_samples.h"
#include "viewer/methods/caches.h"
#include "viewer/methods/row_painter.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// One row of voxels for the shading kernel, padded to whole vectors.
struct VoxelRow {
  std::vector<float> density, gradients, unitDistances, viewerX, viewerY, viewerZ, shaded;
  explicit VoxelRow(int count) {
    const std::size_t n =
        std::size_t(count + RayGenerator::padding - 1) / RayGenerator::padding * RayGenerator::padding;
    for (auto* v : {&density, &unitDistances, &viewerX, &viewerY, &viewerZ}) v->assign(n, 0.0f);
    gradients.assign(4 * n, 0.0f);
    shaded.assign(4 * n, 0.0f);
    std::fill_n(unitDistances.begin(), count, 1.0f);
  }
};

class VoxelShader {
 public:
  VoxelShader(const Plan& plan, const RenderInputs& inputs, const VoxelGeometry& geometry)
      : inputs_(inputs.trace()), geometry_(geometry), bits_(plan.bits), gradients_(plan.gradients) {
    shade_ = chooseShadeKernel(inputs.key());
    const Camera& camera = *plan.scene.camera;
    const glm::dvec3 direction = cameraAxes(camera).direction;
    towardsViewer_ = -direction;
    eyes_ = plan.scene.shading.localViewer && camera.projection == Projection::perspective;
    eye_ = *camera.target - camera.distance * direction;
  }

  // Writes the voxels (0 .. n, j, k) to rgba.
  void shadeRow(int j, int k, VoxelRow& row, float* rgba) const {
    const int n = inputs_.size.x;
    const std::size_t first = (std::size_t(k) * inputs_.size.y + j) * n;
    read(first, n, row);
    for (int i = 0; i < n; ++i) {
      const glm::dvec3 p = geometry_.patientFromVoxel({i, j, k});
      const glm::vec3 e = eyes_ && p != eye_ ? glm::vec3(glm::normalize(eye_ - p)) : towardsViewer_;
      row.viewerX[i] = e.x, row.viewerY[i] = e.y, row.viewerZ[i] = e.z;
    }
    const TraceRow out = traceRowOf(row.shaded);
    shade_(inputs_,
           {int(row.density.size()), row.density.data(), row.gradients.data(), row.unitDistances.data(),
            row.viewerX.data(), row.viewerY.data(), row.viewerZ.data()},
           out);
    const float* components[] = {out.red, out.green, out.blue, out.alpha};
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < 4; ++c) rgba[4 * (first + i) + c] = components[c][i];
  }

 private:
  void read(std::size_t first, int n, VoxelRow& row) const {
    if (bits_ == 16) {
      const int flip = int(inputs_.flip16 & 0xffff);
      for (int i = 0; i < n; ++i) row.density[i] = float(std::int16_t(inputs_.density16[first + i] ^ flip));
      if (gradients_)
        std::copy_n(inputs_.voxels16 + 4 * (first / n * inputs_.gradientRow), 4 * n, row.gradients.begin());
      return;
    }
    std::copy_n(inputs_.density32 + first, n, row.density.begin());
    if (gradients_) std::copy_n(inputs_.gradients32 + 4 * first, 4 * n, row.gradients.begin());
  }

  const RayInputs& inputs_;
  const VoxelGeometry& geometry_;
  ShadeKernel shade_;
  int bits_;
  bool gradients_, eyes_ = false;
  glm::dvec3 eye_{0};
  glm::vec3 towardsViewer_{0};
};

}  // namespace

Buffer<float> shadeVoxels(const Plan& plan, const RenderInputs& inputs, const VoxelGeometry& geometry,
                          const CancelToken& cancel) {
  Buffer<float> rgba(std::size_t(4) * std::size_t(geometry.voxelCount()));
  const VoxelShader shader(plan, inputs, geometry);
  const glm::ivec3 size = geometry.size;
  parallelFor(std::int64_t(size.y) * size.z, plan.options.threads,
              [&](std::int64_t first, std::int64_t last) {
                VoxelRow row(size.x);
                for (std::int64_t n = first; n < last && !cancel.cancelled(); ++n)
                  shader.shadeRow(int(n % size.y), int(n / size.y), row, rgba.data());
              });
  return rgba;
}

Result<Rendered> renderPreshaded(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  Rendered done;
  RenderStats& stats = done.stats;
  const VoxelGeometry& geometry = caches.volume()->geometry();
  const RenderInputs inputs(plan, caches, stats);
  const double begin = wallMs();
  const Buffer<float> shaded = shadeVoxels(plan, inputs, geometry, cancel);
  if (cancel.cancelled()) return Error{"cancelled"};
  const double shadedAt = wallMs();
  const RayGenerator setup(plan, geometry);
  const PreshadedKernel trace = choosePreshadedKernel();
  TraceTotals totals;
  preparePicture(plan, done.picture);
  parallelFor(plan.options.size.y, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
    RayRow rays;
    std::vector<float> values;
    TraceCounts counts;
    for (int y = int(first); y < last && !cancel.cancelled(); ++y) {
      setup.makeRays(0, y, plan.options.size.x, rays);
      values.assign(4 * rays.steps.size(), 0.0f);
      const TraceRow out = traceRowOf(values);
      trace(shaded.data(), inputs.trace(), rays, out, counts);
      writePixels(plan.scene.background, rays, out, done.picture);
    }
    totals.add(counts);
  });
  if (cancel.cancelled()) return Error{"cancelled"};
  totals.report(plan, 0, stats);
  stats.resampleMs = wallMs() - shadedAt;
  stats.shadeMs = shadedAt - begin;
  stats.shaded = plan.lit ? geometry.voxelCount() : 0;
  stats.densityBytes += shaded.bytes();
  return done;
}

}  // namespace volumen
