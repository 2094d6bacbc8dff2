// Lights the samples that contribute. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_LIGHT_INL_H_
#undef VOLUMEN_KERNELS_LIGHT_INL_H_
#else
#define VOLUMEN_KERNELS_LIGHT_INL_H_
#endif

#include <algorithm>
#include <vector>

#include "viewer/kernels/classify_and_light-inl.h"
#include "viewer/kernels/compact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Samples in flight, in the order of each ray's steps.
template <int kCapacity>
struct Samples {
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity], density[kCapacity];
  HWY_ALIGN float unitDistances[kCapacity];  ///< Length of the interval in unit distances.
  HWY_ALIGN float weight[kCapacity];         ///< First the opacity, then the contribution to the ray.
  HWY_ALIGN std::int32_t ray[kCapacity], segment[kCapacity];
  int size = 0;

  /// Fills the rest of the last vector with harmless positions inside the volume.
  HWY_INLINE void Pad() {
    const DF df;
    for (float* values : {x, y, z, density, unitDistances, weight})
      hn::StoreU(hn::Zero(df), df, values + size);
    for (std::int32_t* values : {ray, segment}) hn::StoreU(hn::Zero(DI()), DI(), values + size);
  }
};

/// Samples that wait for light. Each sample is computed independently and added to its ray in order of
/// arrival.
template <class Store, bool kIsLit, bool kGradientOpacity>
class LightQueue {
 public:
  using Material = ClassifyAndLight<kIsLit, kGradientOpacity>;

  LightQueue(const Grid& grid, std::size_t rays, const Material& matter, TraceCounts& counts)
      : grid_(grid), material_(matter), counts_(counts), colour_(4 * rays + 4) {}

  /// Takes the samples of `s` from n on that have weight.
  template <int kCapacity>
  HWY_INLINE void Take(const Samples<kCapacity>& s, int n) {
    const DF df;
    const DI di;
    const VF weight = hn::Load(df, s.weight + n);
    const MF counts = hn::And(hn::Gt(weight, hn::Zero(df)), hn::FirstN(df, std::size_t(s.size - n)));
    auto& w = waiting_;
    if constexpr (Material::kLit) {
      const V3 place = PlaceOf(s, n);
      const CellIndices at(grid_.CellAt(place));
      Store::template Prefetch<true>(grid_, at.lane, std::min(kLanes, s.size - n));
      AppendPlaces(place, counts, w, w.size);
    }
    Append(hn::Load(df, s.density + n), counts, w.density + w.size);
    Append(weight, counts, w.weight + w.size);
    Append(hn::Load(di, s.segment + n), counts, w.segment + w.size);
    Append(hn::Load(di, s.ray + n), counts, w.ray + w.size);
    w.size += int(hn::CountTrue(df, counts));
    if (w.size > kWaiting - 2 * kLanes) Shade();
  }

  /// Lights the waiting samples and writes the sums of all rays.
  void Finish(const TraceRow& out) {
    Shade();
    for (std::size_t n = 0; 4 * n + 4 < colour_.size(); ++n) {
      out.red[n] = colour_[4 * n];
      out.green[n] = colour_[4 * n + 1];
      out.blue[n] = colour_[4 * n + 2];
    }
  }

 private:
  static constexpr int kWaiting = 512;

  HWY_NOINLINE void Shade() {
    auto& s = waiting_;
    if (s.size == 0) return;
    const std::int64_t begin = Ticks();
    s.Pad();
    for (int n = 0; n < s.size; n += kLanes) {
      V3 stored = Zero3();
      if constexpr (Material::kLit) stored = GradientAt(PlaceOf(s, n));
      const V3 colour = material_.ColourAt(hn::Load(DI(), s.segment + n), hn::Load(DF(), s.density + n),
                                           stored, hn::Load(DI(), s.ray + n));
      hn::StoreInterleaved4(colour.x, colour.y, colour.z, hn::Zero(DF()), DF(), lit_ + 4 * n);
    }
    for (int n = 0; n < s.size; ++n) AddToRay(n);
    counts_.composited += s.size;
    s.size = 0;
    counts_.shadeTicks += Ticks() - begin;
  }

  HWY_INLINE V3 GradientAt(const V3& clamped) const { return Store::Gradient(grid_, grid_.CellAt(clamped)); }

  HWY_INLINE void AddToRay(int n) {
    const hn::CappedTag<float, 4> d4;
    for (int c = 0; c < 4; c += int(hn::MaxLanes(d4))) {
      float* sum = colour_.data() + 4 * waiting_.ray[n] + c;
      const auto part = hn::Mul(hn::Load(d4, lit_ + 4 * n + c), hn::Set(d4, waiting_.weight[n]));
      hn::StoreU(hn::Add(hn::LoadU(d4, sum), part), d4, sum);
    }
  }

  const Grid& grid_;
  const Material& material_;
  TraceCounts& counts_;
  Samples<kWaiting> waiting_;
  HWY_ALIGN float lit_[4 * kWaiting];  ///< Colours of the waiting samples: red, green, blue, 0.
  std::vector<float> colour_;          ///< Per ray: red, green, blue, 0.
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
