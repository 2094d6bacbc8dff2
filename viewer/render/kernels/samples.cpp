// Resampling and shading apart from each other, for methods whose slices lie in memory between the two.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/render/kernels/samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/render/kernels/bytes-inl.h"
#include "viewer/render/kernels/matter-inl.h"
#include "viewer/render/kernels/samples.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

template <class Store>
void ResampleRow(const TraceFrame& f, const RayRow& rays, int n, float* density, float* gradients) {
  const DF df;
  const Grid grid(f);
  const VF none = hn::Zero(df);
  for (int first = 0; first < rays.count; first += int(hn::Lanes(df))) {
    const Packet p = LoadPacket(f, rays, first);
    if (n >= p.longest) continue;
    const Cell cell = grid.CellAt(grid.Clamped(Position(p, Set(float(n)), IsLast(p, Set(float(n))))));
    const VF d = Store::Density(grid, cell);
    hn::StoreU(d, df, density + first);
    if (!gradients || hn::AllTrue(df, hn::Eq(OpacityOf(*f.curve, SegmentOf(*f.curve, d), d), none))) continue;
    if constexpr (!std::is_same_v<Store, Byte1Store>) {
      const V3 g = Store::Gradient(grid, cell);
      hn::StoreInterleaved4(g.x, g.y, g.z, none, df, gradients + 4 * first);
    }
  }
}

template <ShadeBy kShade, bool kGradientOpacity>
std::int64_t ShadeSamples(const TraceFrame& f, const SampleRow& s, const TraceRow& out) {
  const DF df;
  const VF zero = hn::Zero(df);
  Matter<kShade, kGradientOpacity> matter{f, s.viewerX, s.viewerY, s.viewerZ};
  std::int64_t visible = 0;
  for (int first = 0; first < s.count; first += int(hn::Lanes(df))) {
    const VF density = hn::LoadU(df, s.density + first), units = hn::LoadU(df, s.units + first);
    const VI segment = SegmentOf(*f.curve, density);
    const MF taken = hn::And(hn::Gt(units, zero), matter.CanBeSeen(density));
    if (hn::AllFalse(df, taken)) {
      for (float* c : {out.red, out.green, out.blue, out.alpha}) hn::StoreU(zero, df, c + first);
      continue;
    }
    V3 gradient = Zero3();
    VF unused;
    if constexpr (matter.kGradients)
      hn::LoadInterleaved4(df, s.gradients + 4 * first, gradient.x, gradient.y, gradient.z, unused);
    const VF opacity = hn::IfThenElseZero(taken, matter.OpacityAt(segment, density, gradient));
    const VF alpha = IntervalOpacity(opacity, units);
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

template <bool kRounded>
void BlendRow(const TraceRow& slice, const TraceRow& frame, int count, float levels) {
  const DF df;
  const float* const sources[] = {slice.red, slice.green, slice.blue, slice.alpha};
  float* const targets[] = {frame.red, frame.green, frame.blue, frame.alpha};
  const VF one = Set(1);
  for (int first = 0; first < count; first += int(hn::Lanes(df))) {
    const VF through = hn::Sub(one, hn::LoadU(df, slice.alpha + first));
    for (int c = 0; c < 4; ++c) {
      const VF source = hn::LoadU(df, sources[c] + first);
      const VF behind = hn::Mul(through, hn::LoadU(df, targets[c] + first));
      VF sum = hn::Add(kRounded ? hn::Min(source, one) : source, behind);
      if constexpr (kRounded) {
        const VF whole = hn::Add(hn::Mul(hn::Min(sum, one), Set(levels)), Set(0.5f));
        sum = hn::Div(hn::ConvertTo(df, hn::ConvertTo(DI(), whole)), Set(levels));
      }
      hn::StoreU(sum, df, targets[c] + first);
    }
  }
}

BlendKernel ChooseBlend(bool rounded) { return rounded ? BlendRow<true> : BlendRow<false>; }

ResampleKernel ChooseResample(Store store) {
  return store == Store::int16   ? ResampleRow<Int16Store>
         : store == Store::byte1 ? ResampleRow<Byte1Store>
         : store == Store::byte4 ? ResampleRow<Byte4Store>
                                 : ResampleRow<Float32Store>;
}

template <ShadeBy kShade>
ShadeKernel ChooseOpacity(bool gradientOpacity) {
  return gradientOpacity ? ShadeSamples<kShade, true> : ShadeSamples<kShade, false>;
}

ShadeKernel ChooseShadeSamples(TraceKey key) {
  switch (key.shade) {
    case ShadeBy::map:
      return ChooseOpacity<ShadeBy::map>(key.gradientOpacity);
    case ShadeBy::mapNearest:
      return ChooseOpacity<ShadeBy::mapNearest>(key.gradientOpacity);
    case ShadeBy::table:
      return ChooseOpacity<ShadeBy::table>(key.gradientOpacity);
    case ShadeBy::phong:
      return ChooseOpacity<ShadeBy::phong>(key.gradientOpacity);
    case ShadeBy::local:
      return ChooseOpacity<ShadeBy::local>(key.gradientOpacity);
    case ShadeBy::nothing:
      break;
  }
  return ChooseOpacity<ShadeBy::nothing>(key.gradientOpacity);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseResample);
HWY_EXPORT(ChooseShadeSamples);
HWY_EXPORT(ChooseBlend);

ResampleKernel chooseResampleKernel(Store store) { return HWY_DYNAMIC_DISPATCH(ChooseResample)(store); }
BlendKernel chooseBlendKernel(bool rounded) { return HWY_DYNAMIC_DISPATCH(ChooseBlend)(rounded); }
ShadeKernel chooseShadeKernel(TraceKey key) { return HWY_DYNAMIC_DISPATCH(ChooseShadeSamples)(key); }

}  // namespace volumen
#endif  // HWY_ONCE
