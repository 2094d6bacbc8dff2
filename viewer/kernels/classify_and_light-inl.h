// Opacity and light of samples. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_CLASSIFY_AND_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_CLASSIFY_AND_LIGHT_INL_H_
#undef VOLUMEN_KERNELS_CLASSIFY_AND_LIGHT_INL_H_
#else
#define VOLUMEN_KERNELS_CLASSIFY_AND_LIGHT_INL_H_
#endif

#include "viewer/kernels/packet-inl.h"
#include "viewer/kernels/sample-inl.h"
#include "viewer/kernels/shade-inl.h"
#include "viewer/kernels/table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

#ifdef __x86_64__
HWY_INLINE std::int64_t Ticks() { return std::int64_t(__builtin_ia32_rdtsc()); }
#else
HWY_INLINE std::int64_t Ticks() { return 0; }
#endif

/// CorrectedOpacity for the usual case: most intervals of a picture have the same length and few opacities
/// are near 1. A short series then replaces a logarithm and an exponential.
HWY_INLINE VF CorrectedOpacity(const CorrectionSeries& series, VF opacity, VF unitDistances) {
  const DF df;
  if (series.terms == 0) return CorrectedOpacity(opacity, unitDistances);
  const VF square = hn::Mul(opacity, opacity);
  const auto pair = [&](int k) { return hn::Add(Set(series.c[k]), hn::Mul(opacity, Set(series.c[k + 1]))); };
  VF sum = hn::Add(pair(2), hn::Mul(square, pair(4)));
  if (series.terms > 6) {
    const VF last = hn::Add(pair(6), hn::Mul(square, pair(8)));
    sum = hn::Add(sum, hn::Mul(hn::Mul(square, square), last));
  }
  sum = hn::Add(pair(0), hn::Mul(square, sum));
  const VF fast = hn::Mul(sum, opacity);
  // Missing samples have length 0.
  const MF fits =
      hn::Or(hn::And(hn::Eq(unitDistances, Set(series.unitDistances)), hn::Le(opacity, Set(series.most))),
             hn::Eq(unitDistances, hn::Zero(df)));
  if (hn::AllTrue(df, fits)) return fast;
  return hn::IfThenElse(fits, fast, PowerOpacity(opacity, unitDistances, fits));
}

/// Properties of a sample for lighting, and for bounding the change of light to the next sample.
struct Fragment {
  V3 colour;  ///< Colour of the curve.
  V3 normal;  ///< Unit vector.
  VF share;   ///< Weight of the normal: less than 1 where the gradient is below the floor of picture.md 5.
  VI sides;   ///< Result of SidesOf().
};

HWY_INLINE Fragment Chosen(MF which, const Fragment& a, const Fragment& b) {
  return {IfThenElse3(which, a.colour, b.colour), IfThenElse3(which, a.normal, b.normal),
          hn::IfThenElse(which, a.share, b.share),
          hn::IfThenElse(hn::RebindMask(DI(), which), a.sides, b.sides)};
}

/// Classification and lighting for one picture.
template <bool kIsLit, bool kGradientOpacity>
struct ClassifyAndLight {
  static constexpr bool kLit = kIsLit, kFactors = kGradientOpacity;
  static constexpr bool kGradients = kLit || kFactors;
  const RayInputs& f;
  /// Direction of each ray towards the viewer, in patient space. Read only with a local viewer.
  const float *viewerX, *viewerY, *viewerZ;
  int first = 0;  ///< Ray from which ray numbers are counted.

  /// Returns the samples whose density can have opacity.
  HWY_INLINE MF CanBeSeen(VF density) const {
    return hn::And(hn::Ge(density, Set(f.curve->visibleLow)), hn::Le(density, Set(f.curve->visibleHigh)));
  }

  /// Returns the opacity of a sample per unit distance. `stored`: its gradient, read only if opacity depends
  /// on it.
  HWY_INLINE VF OpacityAt(VI segment, VF density, const V3& stored) const {
    const VF opacity = OpacityOf(*f.curve, segment, density);
    if constexpr (kGradientOpacity)
      return hn::Mul(opacity, FactorAt(stored));
    else
      return opacity;
  }

  /// Returns the opacity of the whole interval of a sample.
  HWY_INLINE VF CorrectedOpacityAt(VI segment, VF density, const V3& stored, VF unitDistances) const {
    return CorrectedOpacity(f.intervals, OpacityAt(segment, density, stored), unitDistances);
  }

  /// Returns gradientOpacity of picture.md 4.
  HWY_INLINE VF FactorAt(const V3& stored) const {
    return GradientFactor(*f.transfer, NormalOf(f, stored).length);
  }

  /// Returns the lit colour of a sample (picture.md 5). `ray` is counted from `first`.
  HWY_INLINE V3 ColourAt(VI segment, VF density, const V3& stored, VI ray) const {
    if constexpr (kLit)
      if (f.light == LightModel::table) return ShadeByTable(*f.table, stored, density);
    return Shaded(ColourOf(*f.curve, segment, density), stored, ray);
  }

  /// Returns the fragment for a colour of the curve and a stored gradient, on the ray `ray`.
  HWY_INLINE Fragment FragmentOf(const V3& colour, const V3& stored, VI ray) const {
    if constexpr (!kLit) return {colour, Zero3(), hn::Zero(DF()), SetI(0)};
    const Normal normal = NormalOf(f, stored);
    const V3 viewer = f.lighting->localViewer ? ViewerOf(ray) : Broadcast(f.lighting->viewer);
    return {colour, normal.n, ShareOfNormal(f, normal.length), SidesOf(*f.lighting, normal.n, viewer)};
  }

  /// Returns the fragment's colour lit with D'' and S'' of picture.md 5. The table model is excluded: it
  /// ignores colours.
  HWY_INLINE V3 LitColour(const Fragment& a, VI ray) const {
    if constexpr (!kLit) return a.colour;
    return Shaded(a.colour, a.normal, a.share, ray);
  }

 private:
  HWY_INLINE V3 Shaded(const V3& colour, const V3& stored, VI ray) const {
    if constexpr (!kLit) return colour;
    const Normal normal = NormalOf(f, stored);
    return Shaded(colour, normal.n, ShareOfNormal(f, normal.length), ray);
  }
  HWY_INLINE V3 Shaded(const V3& colour, const V3& normal, VF share, VI ray) const {
    const DS shade = WithFloor(f, ShadeOf(normal, ray), share);
    return Add({hn::Mul(colour.x, shade.d.x), hn::Mul(colour.y, shade.d.y), hn::Mul(colour.z, shade.d.z)},
               shade.s);
  }

  /// Returns D' and S' of picture.md 5 by the picture's lighting model.
  HWY_INLINE DS ShadeOf(const V3& n, VI ray) const {
    switch (f.light) {
      case LightModel::map:
        return ShadeMap(*f.map, n);
      case LightModel::nearestInMap:
        return ShadeMapNearest(*f.map, n);
      case LightModel::localPhong:
        return ShadePhong<true>(*f.lighting, n, ViewerOf(ray));
      case LightModel::phong:
      case LightModel::table:  // Handled in ColourAt.
        break;
    }
    return ShadePhong<false>(*f.lighting, n, Broadcast(f.lighting->viewer));
  }

  HWY_INLINE V3 ViewerOf(VI ray) const {
    const auto of = [&](const float* v) { return hn::GatherIndex(DF(), v + first, ray); };
    return {of(viewerX), of(viewerY), of(viewerZ)};
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
