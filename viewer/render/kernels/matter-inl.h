// What a sample is: opacity and light, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_MATTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_MATTER_INL_H_
#undef VOLUMEN_RENDER_KERNELS_MATTER_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_MATTER_INL_H_
#endif

#include "viewer/render/kernels/packet-inl.h"
#include "viewer/render/kernels/sample-inl.h"
#include "viewer/render/kernels/shade-inl.h"
#include "viewer/render/kernels/table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

#ifdef __x86_64__
HWY_INLINE std::int64_t Ticks() { return std::int64_t(__builtin_ia32_rdtsc()); }
#else
HWY_INLINE std::int64_t Ticks() { return 0; }
#endif

/// IntervalOpacity: most intervals of a frame are as long as each other and few opacities near 1, so that a
/// short series does in place of a logarithm and an exponential.
HWY_INLINE VF IntervalOpacity(const IntervalSeries& series, VF opacity, VF units) {
  const DF df;
  if (series.terms == 0) return IntervalOpacity(opacity, units);
  const VF square = hn::Mul(opacity, opacity);
  const auto pair = [&](int k) { return hn::Add(Set(series.c[k]), hn::Mul(opacity, Set(series.c[k + 1]))); };
  VF sum = hn::Add(pair(2), hn::Mul(square, pair(4)));
  if (series.terms > 6) {
    const VF last = hn::Add(pair(6), hn::Mul(square, pair(8)));
    sum = hn::Add(sum, hn::Mul(hn::Mul(square, square), last));
  }
  sum = hn::Add(pair(0), hn::Mul(square, sum));
  const VF fast = hn::Mul(sum, opacity);
  // Samples that are not there have no length.
  const MF fits = hn::Or(hn::And(hn::Eq(units, Set(series.units)), hn::Le(opacity, Set(series.most))),
                         hn::Eq(units, hn::Zero(df)));
  if (hn::AllTrue(df, fits)) return fast;
  return hn::IfThenElse(fits, fast, PowerOpacity(opacity, units, fits));
}

/// Classification and light of one frame.
template <ShadeBy kShade, bool kGradientOpacity>
struct Matter {
  static constexpr bool kGradients = kShade != ShadeBy::nothing || kGradientOpacity;
  const TraceFrame& f;
  /// Of each ray, towards the viewer, patient space; looked at with a local viewer only.
  const float *viewerX, *viewerY, *viewerZ;
  int first = 0;  ///< the ray that the others are counted from

  /// Samples whose density can have opacity.
  HWY_INLINE MF CanBeSeen(VF density) const {
    return hn::And(hn::Ge(density, Set(f.curve->visibleLow)), hn::Le(density, Set(f.curve->visibleHigh)));
  }

  /// Opacity a unit distance of a sample; `stored`: its gradient, read where opacity depends on it.
  HWY_INLINE VF OpacityAt(VI segment, VF density, const V3& stored) const {
    const VF opacity = OpacityOf(*f.curve, segment, density);
    if constexpr (kGradientOpacity)
      return hn::Mul(opacity, FactorAt(stored));
    else
      return opacity;
  }

  /// The same of its whole interval.
  HWY_INLINE VF IntervalOpacityAt(VI segment, VF density, const V3& stored, VF units) const {
    return IntervalOpacity(f.intervals, OpacityAt(segment, density, stored), units);
  }

  /// SCENE 4's gradientOpacity.
  HWY_INLINE VF FactorAt(const V3& stored) const {
    return GradientFactor(*f.transfer, NormalOf(f, stored).length);
  }

  /// Samples whose gradient is so small that it may sink below the floor of SCENE 5 nearby.
  HWY_INLINE MF MayVanishNear(const V3& stored) const {
    const VF share = hn::Mul(NormalOf(f, stored).length, Set(f.inverseFloor));
    return hn::And(hn::Gt(Set(f.inverseFloor), hn::Zero(DF())), hn::Lt(share, Set(4)));
  }

  /// The colour of a sample, lit (SCENE 5); `ray`: its ray, counted from `first`.
  HWY_INLINE V3 ColourAt(VI segment, VF density, const V3& stored, VI ray) const {
    if constexpr (kShade == ShadeBy::nothing) {
      return ColourOf(*f.curve, segment, density);
    } else if constexpr (kShade == ShadeBy::table) {
      return ShadeByTable(*f.table, stored, density);
    } else {
      const V3 colour = ColourOf(*f.curve, segment, density);
      const Normal normal = NormalOf(f, stored);
      const DS shade = WithFloor(f, ShadeOf(normal.n, ray), normal.length);
      return Add({hn::Mul(colour.x, shade.d.x), hn::Mul(colour.y, shade.d.y), hn::Mul(colour.z, shade.d.z)},
                 shade.s);
    }
  }

  /// Where gradients rise about straight from a's to c's over b's.
  static HWY_INLINE MF IsStraight(const V3& a, const V3& b, const V3& c) {
    const V3 bent = Add(Add(a, c), Scale(b, Set(-2))), change = Add(c, Scale(a, Set(-1)));
    return hn::Le(Dot(bent, bent), hn::Mul(Set(0.1f), Dot(change, change)));
  }

  /// The mean colour along an interval with these gradients in the middles of its halves, straight between
  /// them and beyond.
  HWY_INLINE V3 ColourBetween(VI segment, VF density, const V3& stored1, const V3& stored2, VI ray) const {
    const DF df;
    const VF one = Set(1), two = Set(2);
    const V3 g1 = InFloors(stored1), g2 = InFloors(stored2);
    const V3 middle = Scale(Add(g1, g2), Set(0.5f)), half = Scale(Add(g2, Scale(g1, Set(-1))), Set(0.5f));
    const VF square = Dot(middle, middle), cross = hn::Mul(two, Dot(middle, half)), change = Dot(half, half);
    VF mean = hn::Zero(df);
    constexpr int looks = 8;
    for (int n = 0; n < looks; ++n) {
      const VF t = Set((float(n) + 0.5f) * (4.0f / looks) - 2);
      const VF length2 = hn::Add(square, hn::Mul(t, hn::Add(cross, hn::Mul(t, change))));
      mean = hn::Add(mean, hn::Min(one, hn::Sqrt(hn::Max(length2, hn::Zero(df)))));
    }
    mean = hn::Mul(mean, Set(1.0f / looks));
    const VF q1 = hn::Min(one, hn::Sqrt(Dot(g1, g1))), q2 = hn::Min(one, hn::Sqrt(Dot(g2, g2)));
    const VF sum = hn::Add(q1, q2);
    const V3 flat = ColourAt(segment, density, Zero3(), ray);
    const V3 both = Add(ColourAt(segment, density, stored1, ray), ColourAt(segment, density, stored2, ray));
    const MF none = hn::Le(sum, hn::Zero(df));
    const VF share = hn::IfThenElseZero(hn::Not(none), hn::Div(mean, hn::IfThenElse(none, one, sum)));
    const auto mix = [&](VF lit, VF unlit) {
      return hn::Add(hn::Mul(unlit, hn::Sub(one, mean)),
                     hn::Mul(share, hn::Sub(lit, hn::Mul(unlit, hn::Sub(two, sum)))));
    };
    return {mix(both.x, flat.x), mix(both.y, flat.y), mix(both.z, flat.z)};
  }

 private:
  /// A stored gradient in patient space as a share of the floor; far above it clamped.
  HWY_INLINE V3 InFloors(const V3& stored) const {
    const V3 g = Scale(InPatient(f, stored), Set(f.gradientUnit * f.inverseFloor));
    const VF most = Set(1e6f);
    const auto clamped = [&](VF v) { return hn::Max(hn::Neg(most), hn::Min(v, most)); };
    return {clamped(g.x), clamped(g.y), clamped(g.z)};
  }

  HWY_INLINE DS ShadeOf(const V3& n, VI ray) const {
    if constexpr (kShade == ShadeBy::map) {
      return ShadeMap(*f.map, n);
    } else if constexpr (kShade == ShadeBy::mapNearest) {
      return ShadeMapNearest(*f.map, n);
    } else if constexpr (kShade == ShadeBy::phong) {
      return ShadePhong<false>(*f.lighting, n, Broadcast(f.lighting->viewer));
    } else {
      const auto ofRay = [&](const float* v) { return hn::GatherIndex(DF(), v + first, ray); };
      return ShadePhong<true>(*f.lighting, n, {ofRay(viewerX), ofRay(viewerY), ofRay(viewerZ)});
    }
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
