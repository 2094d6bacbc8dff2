#pragma once

#include <span>
#include <vector>

#include "viewer/methods/render_inputs.h"

namespace volumen {

/// Follows rays that meet surfaces of segments (picture.md 10): the volume from one surface to the next, each
/// surface over what lies behind it. Memory of one thread, for one row of rays after another.
class SurfaceStretches {
 public:
  /// Finds what the rays meet; false where no ray meets any surface.
  bool find(const SegmentRays& segments, const RayRow& rays);
  /// Traces the rays of find() stretch by stretch; adds to `out`, which must be 0.
  void trace(const RenderInputs& inputs, TraceKernel kernel, const TraceRow& out, TraceCounts& counts);

 private:
  /// A ray whose next stretch is to be traced.
  struct Ray {
    int pixel = -1;
    std::size_t next = 0, end = 0;  // of met_, what it has still to meet
    double from = 0;                // mm, where the stretch begins
    bool goesOn = false;
  };
  bool gather();
  void traceStretch(const RenderInputs& inputs, TraceKernel kernel, TraceCounts& counts);
  void add(const TraceRow& out) const;
  void cover(float stopTransmittance, const TraceRow& out);

  const SegmentRays* segments_ = nullptr;
  SegmentRays::Task task_;
  std::vector<SegmentRays::Met> met_;
  std::vector<Ray> rays_;
  // The stretches at hand, tile by tile, and which rays they are of.
  std::vector<std::size_t> rayOf_;
  RayParts parts_;
  RayRow row_;
  std::vector<float> values_, error_;
};

}  // namespace volumen
