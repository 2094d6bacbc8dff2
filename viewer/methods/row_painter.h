#pragma once

#include <atomic>
#include <vector>

#include "viewer/methods/render_inputs.h"
#include "viewer/methods/surface_stretches.h"

namespace volumen {

/// Turns rays into pixels: shaded and composited, or projected, over the background.
class RowPainter {
 public:
  /// What it is given must outlive it; picture and error map (Rendered) are made here, in the plan's size.
  RowPainter(const Plan& plan, const RenderInputs& inputs, Picture& picture, std::vector<float>& error);

  /// Memory of one task, and what it counted.
  struct Task {
    std::vector<float> values;  ///< red, green, blue, alpha
    std::vector<float> error;   ///< where the kernel knows it
    TraceCounts counts;
    SurfaceStretches surfaces;  ///< where segments are drawn
  };
  /// Paints the pixels of the rays. `plane`: their samples, where the picture's store is Store::plane.
  void paint(const RayRow& rays, const PlaneBuffer& plane, Task& task) const;

 private:
  bool meetsSurfaces(const RayRow& rays, Task& task) const;
  void writeRounding(const RayRow& rays) const;
  void writeError(const RayRow& rays, const TraceRow& row) const;

  const Plan& plan_;
  const RenderInputs& inputs_;
  Picture& picture_;
  std::vector<float>& error_;
  TraceKernel trace_ = nullptr;      ///< of composite
  ProjectKernel project_ = nullptr;  ///< of the other modes
};

/// Sums over all tasks; integers, so that their order does not matter.
struct TraceTotals {
  std::atomic<std::int64_t> resampled{0}, composited{0}, shadeTicks{0}, allTicks{0}, surfacesNs{0};
  void add(const TraceCounts& c) {
    surfacesNs += c.surfacesNs;
    resampled += c.resampled;
    composited += c.composited;
    shadeTicks += c.shadeTicks;
    allTicks += c.allTicks;
  }
  /// Writes samples, the kernel's name, and the pass's time, shared out between resampling and shading.
  void report(const Plan& plan, double passMs, RenderStats& stats) const;
};

}  // namespace volumen
