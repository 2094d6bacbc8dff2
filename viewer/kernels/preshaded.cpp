// Composites interpolated colours.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/preshaded.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/grid-inl.h"
#include "viewer/kernels/packet-inl.h"
#include "viewer/kernels/preshaded.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

struct PreshadedSum {
  V3 colour;
  VF alpha;
};

/// Traces a vector of neighbouring rays from their first sample to the last that counts.
HWY_INLINE PreshadedSum TracePacket(const float* rgba, const Grid& grid, const Packet& p,
                                    TraceCounts& counts) {
  const DF df;
  const VF zero = hn::Zero(df), one = Set(1), opaque = Set(1 - grid.inputs().stopTransmittance);
  PreshadedSum sum{Zero3(), zero};
  for (int step = 0; step < p.longest; ++step) {
    const VF n = Set(float(step));
    const MF alive = hn::And(HasSample(p, n), hn::Le(sum.alpha, opaque));
    if (hn::AllFalse(df, alive)) break;
    counts.resampled += std::int64_t(hn::CountTrue(df, alive));
    const MF last = IsLast(p, n);
    const Interpolated voxel = InterpolateFour(grid, grid.CellAt(grid.Clamped(Position(p, n, last))), rgba);
    const MF visible = hn::And(alive, hn::Gt(voxel.w, zero));
    if (hn::AllFalse(df, visible)) continue;
    const VF interval = CorrectedOpacity(hn::IfThenElseZero(visible, voxel.w),
                                         hn::IfThenElse(last, p.lastUnitDistances, p.unitDistances));
    const VF weight = hn::IfThenElseZero(visible, hn::Mul(hn::Sub(one, sum.alpha), interval));
    sum.colour = Add(sum.colour, Scale(voxel.xyz, hn::Div(weight, hn::IfThenElse(visible, voxel.w, one))));
    sum.alpha = hn::Add(sum.alpha, weight);
    counts.composited += std::int64_t(hn::CountTrue(df, visible));
  }
  return sum;
}

void TracePreshaded(const float* rgba, const RayInputs& f, const RayRow& rays, const TraceRow& out,
                    TraceCounts& counts) {
  const DF df;
  const Grid grid(f, f.size.x);
  for (int first = 0; first < rays.count; first += int(hn::Lanes(df))) {
    const PreshadedSum sum = TracePacket(rgba, grid, LoadPacket(f, rays, first), counts);
    hn::StoreU(sum.colour.x, df, out.red + first);
    hn::StoreU(sum.colour.y, df, out.green + first);
    hn::StoreU(sum.colour.z, df, out.blue + first);
    hn::StoreU(sum.alpha, df, out.alpha + first);
  }
}

PreshadedKernel ChoosePreshaded() { return TracePreshaded; }

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChoosePreshaded);
PreshadedKernel choosePreshadedKernel() { return HWY_DYNAMIC_DISPATCH(ChoosePreshaded)(); }

}  // namespace volumen
#endif  // HWY_ONCE
