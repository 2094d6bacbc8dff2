// The halves of passages on the curve, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_HALVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_HALVES_INL_H_
#undef VOLUMEN_RENDER_KERNELS_HALVES_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_HALVES_INL_H_
#endif

#include <algorithm>

#include "viewer/render/kernels/compact-inl.h"
#include "viewer/render/kernels/extinction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Both halves of passages, or of their parts: places on the curve at the front, in the middle and at the
/// back; optical depths of the halves.
struct Halves {
  CurvePlace a, m, b;
  VF units, depth1, depth2;
};

/// The halves of a few passages of an array (Intervals), worked out in short passes, so that many are on
/// their way through each at once.
template <class Array>
class HalvesOf {
 public:
  static constexpr int kMost = 8 * kLanes;

  HalvesOf(const CurveTable& curve, const Array& passages) : curve_(curve), of_(passages) {}

  /// Takes up to kMost passages from n on.
  HWY_INLINE void Take(int n, int count) {
    first_ = n;
    count_ = count;
    SetPlaces(of_.front + n, front_);
    SetPlaces(of_.middle + n, middle_);
    SetPlaces(of_.back + n, back_);
    const DF df;
    const auto half = [&](int k) { return hn::Mul(hn::Load(df, of_.units + first_ + k), Set(0.5f)); };
    ForEach([&](int k) {
      hn::Store(hn::Mul(half(k), MeanExtinction(curve_, Front(k), Middle(k))), df, depth1_ + k);
    });
    ForEach([&](int k) {
      hn::Store(hn::Mul(half(k), MeanExtinction(curve_, Middle(k), Back(k))), df, depth2_ + k);
    });
  }

  /// Calls act(k) for each vector of them.
  template <class Do>
  HWY_INLINE void ForEach(const Do& act) const {
    for (int k = 0; k < count_; k += kLanes) act(k);
  }
  int Count(int k) const { return std::min(kLanes, count_ - k); }

  HWY_INLINE Halves At(int k) const {
    const DF df;
    return {Front(k),
            Middle(k),
            Back(k),
            hn::Load(df, of_.units + first_ + k),
            hn::Load(df, depth1_ + k),
            hn::Load(df, depth2_ + k)};
  }

 private:
  struct Places {
    HWY_ALIGN float transparency[kMost], extinction[kMost];
    HWY_ALIGN std::int32_t segment[kMost];
  };

  HWY_INLINE void SetPlaces(const float* density, Places& places) {
    const DF df;
    ForEach([&](int k) {
      const CurvePlace p = PlaceOnCurve(curve_, hn::Load(df, density + k));
      hn::Store(p.transparency, df, places.transparency + k);
      hn::Store(p.extinction, df, places.extinction + k);
      hn::Store(p.segment, DI(), places.segment + k);
    });
  }
  HWY_INLINE CurvePlace PlaceAt(const float* density, const Places& places, int k) const {
    const DF df;
    return {hn::Load(df, density + first_ + k), hn::Load(DI(), places.segment + k),
            hn::Load(df, places.transparency + k), hn::Load(df, places.extinction + k)};
  }
  HWY_INLINE CurvePlace Front(int k) const { return PlaceAt(of_.front, front_, k); }
  HWY_INLINE CurvePlace Middle(int k) const { return PlaceAt(of_.middle, middle_, k); }
  HWY_INLINE CurvePlace Back(int k) const { return PlaceAt(of_.back, back_, k); }

  const CurveTable& curve_;
  const Array& of_;
  int first_ = 0, count_ = 0;
  Places front_, middle_, back_;
  HWY_ALIGN float depth1_[kMost], depth2_[kMost];
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
