// Extinction between two densities, in closed form, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_EXTINCTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_EXTINCTION_INL_H_
#undef VOLUMEN_RENDER_KERNELS_EXTINCTION_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_EXTINCTION_INL_H_
#endif

#include "viewer/render/kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// A density's place on the curve: transparency 1 - opacity and extinction -ln(transparency), a unit
/// distance each.
struct CurvePlace {
  VF density;
  VI segment;
  VF transparency, extinction;
};

HWY_INLINE CurvePlace PlaceOnCurve(const CurveTable& t, VF density) {
  const VI segment = SegmentOf(t, density);
  const Transparency x = TransparencyOf(OpacityOf(t, segment, density));
  return {density, segment, x.left, hn::Neg(x.log)};
}

/// The mean of -ln(u) between two transparencies (u1, e1 = -ln u1), (u2, e2), over which the opacity rises
/// straight: 1 + (u2 e2 - u1 e1) / (u2 - u1), or where they are too near for that difference its series.
HWY_INLINE VF MeanOnSegment(VF u1, VF e1, VF u2, VF e2) {
  const VF change = hn::Sub(u2, u1);
  const MF near = hn::Lt(hn::Abs(change), hn::Mul(u1, Set(0.03f)));
  // One division serves both.
  const VF x = hn::Div(hn::IfThenElse(near, change, hn::Sub(hn::Mul(u2, e2), hn::Mul(u1, e1))),
                       hn::IfThenElse(near, u1, change));
  const VF series = hn::Sub(
      e1, hn::Mul(x, hn::Sub(Set(0.5f), hn::Mul(x, hn::Sub(Set(1.0f / 6), hn::Mul(x, Set(1.0f / 12)))))));
  return hn::IfThenElse(near, series, hn::Add(Set(1), x));
}

/// The mean extinction a unit distance where the density goes straight from a to b: the curve's exact
/// integral, with all peaks and steps that lie between.
HWY_INLINE VF MeanExtinction(const CurveTable& t, const CurvePlace& a, const CurvePlace& b) {
  const DF df;
  const DI di;
  const MF down = hn::Gt(a.density, b.density);
  const auto low = [&](VF x, VF y) { return hn::IfThenElse(down, y, x); };
  const auto high = [&](VF x, VF y) { return hn::IfThenElse(down, x, y); };
  const VI first = hn::IfThenElse(hn::RebindMask(di, down), b.segment, a.segment);
  const VI last = hn::IfThenElse(hn::RebindMask(di, down), a.segment, b.segment);
  const VF u1 = low(a.transparency, b.transparency), e1 = low(a.extinction, b.extinction);
  const VF u2 = high(a.transparency, b.transparency), e2 = high(a.extinction, b.extinction);
  const VF within = MeanOnSegment(u1, e1, u2, e2);
  const MF crosses = hn::RebindMask(df, hn::Ne(first, last));
  if (hn::AllFalse(df, crosses)) return within;
  const VF d1 = low(a.density, b.density), d2 = high(a.density, b.density);
  const auto of = [&](const std::vector<float>& values, VI segment) { return OfSegment(t, values, segment); };
  const VI behind = hn::Min(hn::Add(first, SetI(1)), last);
  const VF end = of(t.start, behind), start = of(t.start, last);
  const VF begun = hn::Mul(MeanOnSegment(u1, e1, of(t.endTransparency, first), of(t.endExtinction, first)),
                           hn::Sub(end, d1));
  const VF ended = hn::Mul(MeanOnSegment(of(t.startTransparency, last), of(t.startExtinction, last), u2, e2),
                           hn::Sub(d2, start));
  const VF whole = hn::Add(hn::Sub(of(t.integral, last), of(t.integral, behind)),
                           hn::Sub(of(t.integralRest, last), of(t.integralRest, behind)));
  const VF mean =
      hn::Div(hn::Add(hn::Add(begun, whole), ended), hn::IfThenElse(crosses, hn::Sub(d2, d1), Set(1)));
  return hn::IfThenElse(crosses, hn::Max(mean, hn::Zero(df)), within);
}

/// How much the extinction changes between two densities, and where there is none at all.
struct Variation {
  VF change;
  MF hidden;
};
HWY_INLINE Variation VariationBetween(const CurveTable& t, VF low, VF high) {
  const auto upTo = [&](VI segment, VF density) {
    return OnSegment(t, t.variation, t.variationRise, segment, Along(t, segment, density));
  };
  const VF zero = hn::Zero(DF());
  const VI segment = SegmentOf(t, low);
  const VF change = hn::Sub(upTo(SegmentOf(t, high), high), upTo(segment, low));
  return {change, hn::And(hn::Eq(change, zero), hn::Eq(OpacityOf(t, segment, low), zero))};
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
