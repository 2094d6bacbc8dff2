// Classifying and lighting plain samples, many at a time, compiled once a CPU target.
#if defined(VOLUMEN_KERNELS_SAMPLE_ARRAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_SAMPLE_ARRAYS_INL_H_
#undef VOLUMEN_KERNELS_SAMPLE_ARRAYS_INL_H_
#else
#define VOLUMEN_KERNELS_SAMPLE_ARRAYS_INL_H_
#endif

#include "viewer/kernels/classify_and_light-inl.h"
#include "viewer/kernels/compact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Plain samples on their way: each pass puts what it finds in the place of what it no longer needs.
template <int kCapacity>
struct SampleArrays {
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity];  ///< place, in its cell, gradient, colour
  HWY_ALIGN float density[kCapacity];
  HWY_ALIGN float
      unitDistances[kCapacity];             ///< length in unit distances, 0 where there is none; then opacity
  HWY_ALIGN std::int32_t index[kCapacity];  ///< of the cell, then segment of the curve
  int size = 0;
};

/// From densities, gradients and lengths to segments and opacities.
template <class Material, class Arrays>
HWY_INLINE void Classify(const Material& matter, Arrays& s) {
  const DF df;
  for (int n = 0; n < s.size; n += kLanes) {
    const VF density = hn::Load(df, s.density + n), unitDistances = hn::Load(df, s.unitDistances + n);
    const VI segment = SegmentOf(*matter.f.curve, density);
    const VF opacity = matter.CorrectedOpacityAt(segment, density, PlaceOf(s, n), unitDistances);
    hn::Store(hn::IfThenElseZero(hn::Gt(unitDistances, hn::Zero(df)), opacity), df, s.unitDistances + n);
    hn::Store(segment, DI(), s.index + n);
  }
}

/// From densities, gradients and segments to colours, lit, of vectors that have any opacity. `rays(n)`: of
/// the n-th sample and those behind it (ClassifyAndLight::ColourAt).
template <class Material, class Arrays, class Rays>
HWY_INLINE void Light(const Material& matter, Arrays& s, const Rays& rays) {
  const DF df;
  for (int n = 0; n < s.size; n += kLanes) {
    if (hn::AllFalse(df, hn::Gt(hn::Load(df, s.unitDistances + n), hn::Zero(df)))) continue;
    const V3 colour =
        matter.ColourAt(hn::Load(DI(), s.index + n), hn::Load(df, s.density + n), PlaceOf(s, n), rays(n));
    hn::Store(colour.x, df, s.x + n);
    hn::Store(colour.y, df, s.y + n);
    hn::Store(colour.z, df, s.z + n);
  }
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
