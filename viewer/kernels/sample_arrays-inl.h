// Classifies and lights plain samples, many at a time. Compiled once per CPU target.
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

/// Plain samples in flight. Each pass overwrites data that is no longer needed with its results.
template <int kCapacity>
struct SampleArrays {
  /// Position, then position in its cell, gradient, and colour.
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity];
  HWY_ALIGN float density[kCapacity];
  HWY_ALIGN float unitDistances[kCapacity];  ///< Length in unit distances, 0 for no sample; then opacity.
  HWY_ALIGN std::int32_t index[kCapacity];   ///< Index of the cell, then segment of the curve.
  int size = 0;
};

/// Computes segments and opacities from densities, gradients and lengths.
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

/// Computes lit colours from densities, gradients and segments, for vectors with any opacity. `rays(n)`
/// returns the rays of the vector of samples at n (ClassifyAndLight::ColourAt).
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
