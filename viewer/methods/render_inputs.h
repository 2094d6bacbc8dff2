#pragma once

#include <optional>
#include <vector>

#include "viewer/kernels/project.h"
#include "viewer/kernels/segment_rays.h"
#include "viewer/methods/render_caches.h"
#include "viewer/methods/rendered.h"

namespace volumen {

/// Everything the kernels read for one picture, made from the plan; keeps what it points to alive.
class RenderInputs {
 public:
  /// Where the plan's resampler is not the CPU, the kernels read planes (Store::plane) in the units of the
  /// plan's store.
  RenderInputs(const Plan& plan, RenderCaches& caches, RenderStats& stats);
  RenderInputs(const RenderInputs&) = delete;
  RenderInputs& operator=(const RenderInputs&) = delete;

  const RayInputs& trace() const { return inputs_; }
  const BlockValues& blocks() const { return blocks_; }  ///< of projections
  const DensityScale& scale() const { return scale_; }
  KernelKey key() const { return key_; }
  const SegmentRays* segments() const { return segments_ ? &*segments_ : nullptr; }  ///< null: none are drawn
  float brightest() const { return brightest_; }  ///< no component of a sample's colour is larger, at least 1

 private:
  void readStored(const Plan& plan, RenderCaches& caches, RenderStats& stats);
  void readBytes(const Plan& plan, RenderCaches& caches, RenderStats& stats);
  void readBlocks(const Plan& plan, int reach, RenderCaches& caches, RenderStats& stats);
  void makeShades(const Plan& plan, RenderCaches& caches);
  /// The largest density, in the units that interpolation rounds.
  void setFactorUnit();
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
  StoredDensities densities_;  ///< that the kernels read, where they are integers
  double rounding_ = 0;        ///< how far stored values may be off the volume's, real units
  double gradientScale_ = 1;   ///< value per voxel of a unit of the stored gradients
  TransferFunction transfer_;
};

/// The quarters of `values` as a row: red, green, blue, alpha.
inline TraceRow traceRowOf(std::vector<float>& values) {
  const std::size_t n = values.size() / 4;
  return {values.data(), values.data() + n, values.data() + 2 * n, values.data() + 3 * n};
}

/// An empty picture of the plan's size.
void preparePicture(const Plan& plan, Picture& picture);
/// Writes the rays' pixels: colour over the background, clamped (picture.md 6).
void writePixels(const Background& background, const RayRow& rays, const TraceRow& row, Picture& picture);
/// The same for projections: densities mapped to grey by the window; rays of no steps show the background.
void writeProjectedPixels(const Scene& scene, const DensityScale& scale, const RayRow& rays,
                          const float* density, Picture& picture);
/// Rounds the rays' pixels as the frame buffer that slices are blended in keeps them.
void roundPixels(Blending blending, const RayRow& rays, Picture& picture);

}  // namespace volumen
