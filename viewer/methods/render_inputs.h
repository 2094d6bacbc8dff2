#pragma once

#include <optional>
#include <vector>

#include "viewer/kernels/project.h"
#include "viewer/kernels/segment_rays.h"
#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"

namespace volumen {

/// Everything the kernels read for one picture, made from the plan. It keeps what it points to alive.
class RenderInputs {
 public:
  /// If the plan's resampler is not the CPU, the kernels read planes (Store::plane) in the units of the
  /// plan's store.
  RenderInputs(const Plan& plan, RenderCaches& caches, RenderStats& stats);
  RenderInputs(const RenderInputs&) = delete;
  RenderInputs& operator=(const RenderInputs&) = delete;

  const RayInputs& trace() const { return inputs_; }
  const BlockValues& blocks() const { return blocks_; }  ///< Block ranges for projections.
  const DensityScale& scale() const { return scale_; }
  KernelKey key() const { return key_; }
  /// Null if none are drawn.
  const SegmentRays* segments() const { return segments_ ? &*segments_ : nullptr; }
  /// Upper bound on the components of sample colours, at least 1.
  float brightest() const { return brightest_; }

 private:
  void readStored(const Plan& plan, RenderCaches& caches, RenderStats& stats);
  void readBytes(const Plan& plan, RenderCaches& caches, RenderStats& stats);
  void readBlocks(const Plan& plan, int reach, RenderCaches& caches, RenderStats& stats);
  void makeShades(const Plan& plan, RenderCaches& caches);
  /// Sets the unit for gradients of gradientOpacity (RayInputs::factorUnit).
  void setFactorUnit();
  /// Returns the largest density, in the units that interpolation rounds.
  double largestRounded(const Plan& plan, ValueRange range) const;
  void setGradientScale(const Plan& plan, const VoxelGeometry& geometry, double scale);

  const KernelKey key_;
  RayInputs inputs_;
  float brightest_ = 1;
  BlockValues blocks_;
  DensityScale scale_;
  CurveTable curve_;
  Lighting lighting_;
  std::optional<SegmentRays> segments_;
  ShadeTable table_;
  StoredDensities densities_;  ///< Integer densities that the kernels read.
  double rounding_ = 0;        ///< Bound on the difference of stored values from the volume's, real units.
  double gradientScale_ = 1;   ///< Value per voxel of one unit of the stored gradients.
  TransferFunction transfer_;
};

/// Returns the quarters of `values` as a row: red, green, blue, alpha.
inline TraceRow traceRowOf(std::vector<float>& values) {
  const std::size_t n = values.size() / 4;
  return {values.data(), values.data() + n, values.data() + 2 * n, values.data() + 3 * n};
}

/// Sets up an empty picture of the plan's size.
void preparePicture(const Plan& plan, Picture& picture);
/// Writes the rays' pixels: colour over the background, clamped (picture.md 6).
void writePixels(const Background& background, const RayRow& rays, const TraceRow& row, Picture& picture);
/// Writes pixels of projections: densities mapped to grey by the window. Rays without steps show the
/// background.
void writeProjectedPixels(const Scene& scene, const DensityScale& scale, const RayRow& rays,
                          const float* density, Picture& picture);
/// Rounds the rays' pixels like the frame buffer in which slices are blended.
void roundPixels(Blending blending, const RayRow& rays, Picture& picture);

}  // namespace volumen
