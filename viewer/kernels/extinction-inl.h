// Extinction between two densities, in closed form. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_EXTINCTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_EXTINCTION_INL_H_
#undef VOLUMEN_KERNELS_EXTINCTION_INL_H_
#else
#define VOLUMEN_KERNELS_EXTINCTION_INL_H_
#endif

#include "viewer/kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Returns the mean of -ln(u) between the transparencies (u1, e1 = -ln u1) and (u2, e2), for opacity that
/// rises linearly. The formula is 1 + (u2 e2 - u1 e1) / (u2 - u1). Its series replaces it where u1 and u2 are
/// too close for the difference.
HWY_INLINE VF MeanOnSegment(VF u1, VF e1, VF u2, VF e2) {
  const VF change = hn::Sub(u2, u1);
  const MF near = hn::Lt(hn::Abs(change), hn::Mul(u1, Set(0.03f)));
  // One division serves both cases.
  const VF x = hn::Div(hn::IfThenElse(near, change, hn::Sub(hn::Mul(u2, e2), hn::Mul(u1, e1))),
                       hn::IfThenElse(near, u1, change));
  const VF series = hn::Sub(
      e1, hn::Mul(x, hn::Sub(Set(0.5f), hn::Mul(x, hn::Sub(Set(1.0f / 6), hn::Mul(x, Set(1.0f / 12)))))));
  return hn::IfThenElse(near, series, hn::Add(Set(1), x));
}

/// Returns where no density between `low` and `high` has opacity.
HWY_INLINE MF IsHiddenBetween(const CurveTable& t, VF low, VF high) {
  return hn::Eq(OfSegment(t, t.shownBefore, SegmentOf(t, low)),
                OfSegment(t, t.shownUpTo, SegmentOf(t, high)));
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
