// Shades samples in memory, whether another resampler or none has put them there.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/shade_samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/classify_and_light-inl.h"
#include "viewer/kernels/shade_samples.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

template <bool kIsLit, bool kGradientOpacity>
std::int64_t ShadeSamples(const RayInputs& f, const SampleRow& s, const TraceRow& out) {
  const DF df;
  const VF zero = hn::Zero(df);
  ClassifyAndLight<kIsLit, kGradientOpacity> matter{f, s.viewerX, s.viewerY, s.viewerZ};
  std::int64_t visible = 0;
  for (int first = 0; first < s.count; first += int(hn::Lanes(df))) {
    const VF density = hn::LoadU(df, s.density + first),
             unitDistances = hn::LoadU(df, s.unitDistances + first);
    const VI segment = SegmentOf(*f.curve, density);
    const MF taken = hn::And(hn::Gt(unitDistances, zero), matter.CanBeSeen(density));
    if (hn::AllFalse(df, taken)) {
      for (float* c : {out.red, out.green, out.blue, out.alpha}) hn::StoreU(zero, df, c + first);
      continue;
    }
    V3 gradient = Zero3();
    VF unused;
    if constexpr (matter.kGradients)
      hn::LoadInterleaved4(df, s.gradients + 4 * first, gradient.x, gradient.y, gradient.z, unused);
    const VF opacity = hn::IfThenElseZero(taken, matter.OpacityAt(segment, density, gradient));
    const VF alpha = CorrectedOpacity(opacity, unitDistances);
    visible += std::int64_t(hn::CountTrue(df, hn::Gt(alpha, zero)));
    matter.first = first;
    const V3 colour = Scale(matter.ColourAt(segment, density, gradient, hn::Iota(DI(), 0)), alpha);
    hn::StoreU(alpha, df, out.alpha + first);
    hn::StoreU(colour.x, df, out.red + first);
    hn::StoreU(colour.y, df, out.green + first);
    hn::StoreU(colour.z, df, out.blue + first);
  }
  return visible;
}

ShadeKernel ChooseShadeSamples(KernelKey key) {
  if (key.gradientOpacity) return key.lit ? ShadeSamples<true, true> : ShadeSamples<false, true>;
  return key.lit ? ShadeSamples<true, false> : ShadeSamples<false, false>;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseShadeSamples);

ShadeKernel chooseShadeKernel(KernelKey key) { return HWY_DYNAMIC_DISPATCH(ChooseShadeSamples)(key); }

}  // namespace volumen
#endif  // HWY_ONCE
