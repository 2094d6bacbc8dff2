#pragma once

#include <span>
#include <vector>

#include "viewer/methods/render_inputs.h"

namespace volumen {

/// Composites rays that meet surfaces of segments (picture.md 10): the volume from one surface to the next,
/// and each surface over what lies behind it. Working memory of one thread, reused for one row of rays after
/// another.
class SurfaceStretches {
 public:
  /// Finds the surfaces that the rays meet. Returns false if no ray meets a surface.
  bool find(const SegmentRays& segments, const RayRow& rays);
  /// Traces the rays of find() stretch by stretch and adds them to `out`, which must be 0.
  void trace(const RenderInputs& inputs, TraceKernel kernel, const TraceRow& out, TraceCounts& counts);

 private:
  /// A ray whose next stretch is to be traced.
  struct Ray {
    int pixel = -1;
    std::size_t next = 0, end = 0;  // The rest of its entries in met_.
    double from = 0;                // Start of the stretch, in mm.
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
  // The current stretches, tile by tile, and their rays.
  std::vector<std::size_t> rayOf_;
  RayParts parts_;
  RayRow row_;
  std::vector<float> values_, error_;
};

}  // namespace volumen
