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

/// A lit colour, the normal it was lit by, shorter where the gradient is below the floor of SCENE 5, and on
/// which sides of light and viewer that lies (SidesOf).
struct Lit {
  V3 colour, normal;
  VI sides;
};

/// Classification and light of one frame.
template <ShadeBy kShade, bool kGradientOpacity>
struct Matter {
  static constexpr bool kLit = kShade != ShadeBy::nothing, kFactors = kGradientOpacity;
  static constexpr bool kGradients = kLit || kFactors;
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

  /// The colour of a sample, lit (SCENE 5); `ray`: its ray, counted from `first`.
  HWY_INLINE V3 ColourAt(VI segment, VF density, const V3& stored, VI ray) const {
    if constexpr (kShade == ShadeBy::table)
      return ShadeByTable(*f.table, stored, density);
    else
      return LitColour(ColourOf(*f.curve, segment, density), stored, ray).colour;
  }

  /// A colour of the curve, lit: with D'' and S'' of SCENE 5. Not by the table, which knows no colours.
  HWY_INLINE Lit LitColour(const V3& colour, const V3& stored, VI ray) const {
    if constexpr (!kLit) {
      return {colour, Zero3(), SetI(0)};
    } else {
      const Normal normal = NormalOf(f, stored);
      const DS shade = WithFloor(f, ShadeOf(normal.n, ray), normal.length);
      const VF share = hn::Min(Set(1), hn::Mul(normal.length, Set(f.inverseFloor)));
      return {Add({hn::Mul(colour.x, shade.d.x), hn::Mul(colour.y, shade.d.y), hn::Mul(colour.z, shade.d.z)},
                  shade.s),
              Scale(normal.n, share), SidesOf(*f.lighting, normal.n)};
    }
  }

 private:
  HWY_INLINE DS ShadeOf(const V3& n, VI ray) const {
    if constexpr (kShade == ShadeBy::mapNearest) {
      return ShadeMapNearest(*f.map, n);
    } else {
      constexpr bool any = kShade == ShadeBy::asFrame;
      if (kShade == ShadeBy::map || (any && f.map)) return ShadeMap(*f.map, n);
      if (kShade == ShadeBy::phong || (any && !f.lighting->localViewer))
        return ShadePhong<false>(*f.lighting, n, Broadcast(f.lighting->viewer));
      const auto ofRay = [&](const float* v) { return hn::GatherIndex(DF(), v + first, ray); };
      return ShadePhong<true>(*f.lighting, n, {ofRay(viewerX), ofRay(viewerY), ofRay(viewerZ)});
    }
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
