// Compositing of colours that were interpolated.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/render/kernels/preshaded.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "viewer/render/kernels/fetch-inl.h"
#include "viewer/render/kernels/preshaded.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

struct PreshadedSum {
  V3 colour;
  VF alpha;
};

/// A vector of neighbouring rays from their first sample to the last that counts.
HWY_INLINE PreshadedSum TracePacket(const PreshadedVoxels& voxels, const TraceFrame& f, const RayRow& rays,
                                    int first, TraceCounts& counts) {
  const DF df;
  const Strides strides(voxels.size);
  const VF zero = hn::Zero(df), opaque = Set(1 - f.stopTransmittance), unit = Set(f.inverseUnitMm);
  const VI steps = hn::LoadU(DI(), rays.steps.data() + first);
  const VF units = hn::Mul(hn::LoadU(df, rays.stepMm.data() + first), unit);
  const VF lastUnits = hn::Mul(hn::LoadU(df, rays.lastStepMm.data() + first), unit);
  const int longest = *std::max_element(rays.steps.data() + first, rays.steps.data() + first + hn::Lanes(df));
  PreshadedSum sum{{zero, zero, zero}, zero};
  HWY_ALIGN float four[HWY_MAX_BYTES];
  for (int n = 0; n < longest; ++n) {
    const MF has = hn::RebindMask(df, hn::Gt(steps, SetI(n)));
    const MF alive = hn::And(has, hn::Le(sum.alpha, opaque));
    if (hn::AllFalse(df, alive)) break;
    counts.resampled += std::int64_t(hn::CountTrue(df, alive));
    InterpolateFour(strides, strides.CellsAt(SamplePosition(rays, first, n)), voxels.rgba, four);
    V3 colour;
    VF opacity;
    hn::LoadInterleaved4(df, four, colour.x, colour.y, colour.z, opacity);
    const MF visible = hn::And(alive, hn::Gt(opacity, zero));
    if (hn::AllFalse(df, visible)) continue;
    const MF last = hn::RebindMask(df, hn::Eq(steps, SetI(n + 1)));
    const VF interval =
        IntervalOpacity(hn::IfThenElseZero(visible, opacity), hn::IfThenElse(last, lastUnits, units));
    const VF weight = hn::IfThenElseZero(visible, hn::Mul(hn::Sub(Set(1), sum.alpha), interval));
    const VF scale = hn::Div(weight, hn::IfThenElse(visible, opacity, Set(1)));
    sum.colour = Add(sum.colour, Scale(colour, scale));
    sum.alpha = hn::Add(sum.alpha, weight);
    counts.composited += std::int64_t(hn::CountTrue(df, visible));
  }
  return sum;
}

void TracePreshaded(const PreshadedVoxels& voxels, const TraceFrame& f, const RayRow& rays,
                    const TraceRow& out, TraceCounts& counts) {
  const DF df;
  for (int first = 0; first < rays.count; first += int(hn::Lanes(df))) {
    const PreshadedSum sum = TracePacket(voxels, f, rays, first, counts);
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
