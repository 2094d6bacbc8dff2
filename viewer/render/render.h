#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "viewer/plan/plan.h"
#include "viewer/render/gl/gl_context.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/picture.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What a picture took. Times in ms of wall clock; resample and shade are summed over threads and divided by
/// their number. With OpenGL, which resamples while the CPU shades: resample is what the CPU had to wait or
/// work for OpenGL, shade the rest.
struct RenderStats {
  double gradientsMs = 0;  ///< Sobel pass and copies made for this picture; 0 where they were there already
  double resampleMs = 0, shadeMs = 0, totalMs = 0;
  double pilotMs = 0;  ///< finding what the plan left open
  double glMs = 0;     ///< what OpenGL itself took; it overlaps with shadeMs where glMs + shadeMs > totalMs
  std::int64_t resampled = 0, shaded = 0, composited = 0;  ///< samples
  std::size_t densityBytes = 0, gradientBytes = 0, blockBytes = 0, tableBytes = 0;
  int threads = 1;
  std::string kernel;  ///< e.g. "AVX3_ZEN4", "reference", "llvmpipe (LLVM 15.0.6, 256 bits)"
};

struct Rendered {
  Picture picture;
  /// How far each pixel may be off (its largest component; 1/255), one entry a pixel: the sum of what its
  /// ray's parts may be off by. Empty where the path that drew it knows none.
  std::vector<float> error;
  RenderStats stats;
  Plan plan;  ///< as drawn: nothing is left open
};

/// What is expensive and reusable of one volume, made when first needed: facts, stored density, gradients, GL
/// textures. Each is keyed by exactly what it was computed from. Not for use from two threads at once.
class RenderCaches {
 public:
  explicit RenderCaches(VolumePtr volume);
  ~RenderCaches();
  RenderCaches(RenderCaches&&) noexcept;
  RenderCaches& operator=(RenderCaches&&) noexcept;

  const VolumePtr& volume() const;
  const VolumeFacts& facts();

  /// Where the OpenGL context comes from when a plan first asks for one: on the thread that renders, on which
  /// these caches must then also be destroyed. The default is EGL's, without a display. Drops a context that
  /// is there.
  void setGlContextFactory(GlContextFactory factory);

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// The plan with nothing left open: makePlan() with what a pilot (probe) finds. What comes of it depends on
/// the picture alone, not on the machine. Adds to the times of `stats`. Errors as render().
Result<Plan> settled(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                     const CancelToken& cancel = {});

/// Draws the plan, settled. An Error where it was cancelled ("cancelled") or a resource is missing (a
/// sentence).
Result<Rendered> render(const Plan& plan, RenderCaches& caches, const CancelToken& cancel = {});

}  // namespace volumen
