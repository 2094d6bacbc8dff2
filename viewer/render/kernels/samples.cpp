// Resampling and shading apart from each other, for methods whose slices lie in memory between the two.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/render/kernels/samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/render/kernels/fetch-inl.h"
#include "viewer/render/kernels/samples.h"
#include "viewer/render/kernels/shade-inl.h"
#include "viewer/render/kernels/table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

HWY_INLINE VF CurveOpacity(const CurveTable& curve, VF density) {
  return OpacityOf(curve, SegmentOf(curve, density), density);
}

template <bool k16>
HWY_INLINE VF DensityOf(const TraceFrame& f, const Strides& s, const CellVector& c) {
  const DF df;
  const DI di;
  if constexpr (k16) {
    // One 32-bit gather brings a voxel and its neighbour along i.
    const auto* base = reinterpret_cast<const std::int32_t*>(f.density16);
    return Interpolate(s, c, [&](VI index, VF fx) {
      const VI both = hn::Xor(hn::GatherOffset(di, base, hn::ShiftLeft<1>(index)), SetI(int(f.flip16)));
      const VF a = hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(both)));
      return Lerp(a, hn::ConvertTo(df, hn::ShiftRight<16>(both)), fx);
    });
  } else {
    return Interpolate(s, c, [&](VI index, VF fx) {
      return Lerp(hn::GatherIndex(df, f.density32, index), hn::GatherIndex(df, f.density32 + s.next, index),
                  fx);
    });
  }
}

template <bool k16>
void ResampleRow(const TraceFrame& f, const RayRow& rays, int n, float* density, float* gradients) {
  const DF df;
  const Strides strides(f.size);
  const VF none = hn::Zero(df);
  for (int first = 0; first < rays.count; first += int(hn::Lanes(df))) {
    const VI steps = hn::LoadU(DI(), rays.steps.data() + first);
    if (hn::AllFalse(DI(), hn::Gt(steps, SetI(n)))) continue;
    const CellVector cells = strides.CellsAt(SamplePosition(rays, first, n));
    const VF d = DensityOf<k16>(f, strides, cells);
    hn::StoreU(d, df, density + first);
    if (!gradients || hn::AllTrue(df, hn::Eq(CurveOpacity(*f.curve, d), none))) continue;
    if constexpr (k16)
      InterpolateFour(strides, cells, f.voxels16, gradients + 4 * first);
    else
      InterpolateFour(strides, cells, f.gradients32, gradients + 4 * first);
  }
}

template <ShadeBy kShade>
HWY_INLINE V3 LitColour(const TraceFrame& f, const SampleRow& s, int first, VI segment, VF density,
                        const V3& gradient) {
  if constexpr (kShade == ShadeBy::table) return ShadeByTable(*f.table, gradient, density);
  const V3 colour = ColourOf(*f.curve, segment, density);
  if constexpr (kShade == ShadeBy::nothing) return colour;
  const Normal normal = NormalOf(f, gradient);
  DS shade;
  if constexpr (kShade == ShadeBy::map) {
    shade = ShadeMap(*f.map, normal.n);
  } else if constexpr (kShade == ShadeBy::mapNearest) {
    shade = ShadeMapNearest(*f.map, normal.n);
  } else if constexpr (kShade == ShadeBy::phong) {
    shade = ShadePhong<false>(*f.lighting, normal.n, Broadcast(f.lighting->viewer));
  } else {
    const DF df;
    shade = ShadePhong<true>(*f.lighting, normal.n,
                             {hn::LoadU(df, s.viewerX + first), hn::LoadU(df, s.viewerY + first),
                              hn::LoadU(df, s.viewerZ + first)});
  }
  const DS lit = WithFloor(f, shade, normal.length);
  return Add({hn::Mul(colour.x, lit.d.x), hn::Mul(colour.y, lit.d.y), hn::Mul(colour.z, lit.d.z)}, lit.s);
}

template <ShadeBy kShade, bool kGradientOpacity>
std::int64_t ShadeSamples(const TraceFrame& f, const SampleRow& s, const TraceRow& out) {
  const DF df;
  const VF zero = hn::Zero(df);
  std::int64_t visible = 0;
  for (int first = 0; first < s.count; first += int(hn::Lanes(df))) {
    const VF density = hn::LoadU(df, s.density + first), units = hn::LoadU(df, s.units + first);
    const VI segment = SegmentOf(*f.curve, density);
    VF opacity = hn::IfThenElseZero(hn::Gt(units, zero), OpacityOf(*f.curve, segment, density));
    if (hn::AllTrue(df, hn::Eq(opacity, zero))) {
      hn::StoreU(zero, df, out.alpha + first);
      for (float* c : {out.red, out.green, out.blue}) hn::StoreU(zero, df, c + first);
      continue;
    }
    V3 gradient{zero, zero, zero};
    VF unused;
    if constexpr (kShade != ShadeBy::nothing || kGradientOpacity)
      hn::LoadInterleaved4(df, s.gradients + 4 * first, gradient.x, gradient.y, gradient.z, unused);
    if constexpr (kGradientOpacity)
      opacity = hn::Mul(opacity, GradientFactor(*f.transfer, NormalOf(f, gradient).length));
    const VF alpha = hn::IfThenElseZero(hn::Gt(opacity, zero), IntervalOpacity(opacity, units));
    visible += std::int64_t(hn::CountTrue(df, hn::Gt(alpha, zero)));
    const V3 colour = Scale(LitColour<kShade>(f, s, first, segment, density, gradient), alpha);
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
  return store == Store::int16 ? ResampleRow<true> : ResampleRow<false>;
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
