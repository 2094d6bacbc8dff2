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

  /// SCENE 4's gradientOpacity.
  HWY_INLINE VF FactorAt(const V3& stored) const {
    return GradientFactor(*f.transfer, NormalOf(f, stored).length);
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

 private:
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
