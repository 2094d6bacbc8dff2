#pragma once

#include <atomic>
#include <vector>

#include "viewer/methods/render_inputs.h"
#include "viewer/methods/surface_stretches.h"

namespace volumen {

/// Paints pixels from rays: shaded and composited, or projected, over the background.
class RowPainter {
 public:
  /// The arguments must outlive it. The constructor sets up the picture and the error map (Rendered) in the
  /// plan's size.
  RowPainter(const Plan& plan, const RenderInputs& inputs, Picture& picture, std::vector<float>& error);

  /// Working memory of one task, and its counts.
  struct Task {
    std::vector<float> values;  ///< Red, green, blue, alpha.
    std::vector<float> error;   ///< Set if the kernel provides it.
    TraceCounts counts;
    SurfaceStretches surfaces;  ///< Used if segments are drawn.
  };
  /// Paints the pixels of the rays. `plane`: their samples if the picture's store is Store::plane.
  void paint(const RayRow& rays, const PlaneBuffer& plane, Task& task) const;

 private:
  bool meetsSurfaces(const RayRow& rays, Task& task) const;
  void writeRounding(const RayRow& rays) const;
  void writeError(const RayRow& rays, const TraceRow& row) const;

  const Plan& plan_;
  const RenderInputs& inputs_;
  Picture& picture_;
  std::vector<float>& error_;
  TraceKernel trace_ = nullptr;      ///< Kernel of composite mode.
  ProjectKernel project_ = nullptr;  ///< Kernel of the other modes.
};

/// Sums over all tasks. They are integers, so that the order of addition does not matter.
struct TraceTotals {
  std::atomic<std::int64_t> resampled{0}, composited{0}, shadeTicks{0}, allTicks{0}, surfacesNs{0};
  void add(const TraceCounts& c) {
    surfacesNs += c.surfacesNs;
    resampled += c.resampled;
    composited += c.composited;
    shadeTicks += c.shadeTicks;
    allTicks += c.allTicks;
  }
  /// Writes the samples, the kernel's name, and the pass's time, divided between resampling and shading.
  void report(const Plan& plan, double passMs, RenderStats& stats) const;
};

}  // namespace volumen
