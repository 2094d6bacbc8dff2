// Lighting samples that count, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_LIGHT_INL_H_
#undef VOLUMEN_RENDER_KERNELS_LIGHT_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_LIGHT_INL_H_
#endif

#include <algorithm>
#include <type_traits>
#include <vector>

#include "viewer/render/kernels/compact-inl.h"
#include "viewer/render/kernels/matter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Samples on their way, in the order of each ray's steps.
template <int kCapacity>
struct Samples {
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity], density[kCapacity];
  HWY_ALIGN float units[kCapacity];   ///< length of the interval in unit distances
  HWY_ALIGN float reach[kCapacity];   ///< Integrated::reach, of refined ones alone
  HWY_ALIGN float weight[kCapacity];  ///< first its opacity, then what it adds to its ray
  HWY_ALIGN std::int32_t ray[kCapacity], segment[kCapacity];
  int size = 0;

  /// Makes what stands in the last vector behind the last sample harmless: places inside the volume.
  HWY_INLINE void Pad() {
    const DF df;
    for (float* values : {x, y, z, density, units, reach, weight})
      hn::StoreU(hn::Zero(df), df, values + size);
    for (std::int32_t* values : {ray, segment}) hn::StoreU(hn::Zero(DI()), DI(), values + size);
  }
};

/// Samples that wait for light. Each is computed by itself and added to its ray in the order they came.
/// `kAlong`: lit along their intervals (TraceFrame::parting).
template <class Store, ShadeBy kShade, bool kGradientOpacity, bool kAlong>
class LightQueue {
  static constexpr bool kLit = kShade != ShadeBy::nothing;

 public:
  using Material = Matter<kShade, kGradientOpacity>;

  LightQueue(const TraceFrame& f, const Grid& grid, const RayRow& rays, const Material& matter,
             TraceCounts& counts)
      : f_(f),
        grid_(grid),
        rays_(rays),
        matter_(matter),
        counts_(counts),
        colour_(4 * rays.steps.size() + 4) {}

  /// Takes the samples of `s` from n on that have any weight.
  template <int kCapacity>
  HWY_INLINE void Take(const Samples<kCapacity>& s, int n) {
    const DF df;
    const DI di;
    const VF weight = hn::Load(df, s.weight + n);
    const MF counts = hn::And(hn::Gt(weight, hn::Zero(df)), hn::FirstN(df, std::size_t(s.size - n)));
    auto& w = waiting_;
    if constexpr (kLit) {
      const V3 place = PlaceOf(s, n);
      const CellIndices at(grid_.CellAt(place));
      Store::template Prefetch<true>(grid_, at.lane, std::min(kLanes, s.size - n));
      AppendPlaces(place, counts, w, w.size);
    }
    if constexpr (kAlong) Append(hn::Load(df, s.reach + n), counts, w.reach + w.size);
    Append(hn::Load(df, s.density + n), counts, w.density + w.size);
    Append(weight, counts, w.weight + w.size);
    Append(hn::Load(di, s.segment + n), counts, w.segment + w.size);
    Append(hn::Load(di, s.ray + n), counts, w.ray + w.size);
    w.size += int(hn::CountTrue(df, counts));
    if (w.size > kWaiting - 2 * kLanes) Shade();
  }

  /// Lights what waits and writes what all rays came to.
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

  /// Samples whose gradient is small: it may vanish within the interval (in a plate's middle, where it turns
  /// over), and with it the light.
  struct Turning {
    HWY_ALIGN float gradientX[kWaiting], gradientY[kWaiting], gradientZ[kWaiting];
    HWY_ALIGN std::int32_t waiting[kWaiting];  ///< which of those that wait
    int size = 0;
  };
  struct NoneTurn {};

  HWY_NOINLINE void Shade() {
    auto& s = waiting_;
    if (s.size == 0) return;
    const std::int64_t begin = Ticks();
    s.Pad();
    for (int n = 0; n < s.size; n += kLanes) {
      V3 stored = Zero3();
      if constexpr (kLit) stored = GradientAt(PlaceOf(s, n));
      const V3 colour = matter_.ColourAt(hn::Load(DI(), s.segment + n), hn::Load(DF(), s.density + n), stored,
                                         hn::Load(DI(), s.ray + n));
      hn::StoreInterleaved4(colour.x, colour.y, colour.z, hn::Zero(DF()), DF(), lit_ + 4 * n);
      if constexpr (kAlong) NoteTurning(n, stored);
    }
    if constexpr (kAlong) LightTurning();
    for (int n = 0; n < s.size; ++n) AddToRay(n);
    counts_.composited += s.size;
    s.size = 0;
    counts_.shadeTicks += Ticks() - begin;
  }

  HWY_INLINE V3 GradientAt(const V3& clamped) const { return Store::Gradient(grid_, grid_.CellAt(clamped)); }

  HWY_INLINE void NoteTurning(int n, const V3& stored) {
    if (f_.parting.light == 0) return;
    const DF df;
    const MF counts = hn::Gt(hn::Load(df, waiting_.weight + n), Set(f_.parting.tolerance));
    const MF small = hn::And(matter_.MayVanishNear(stored), counts);
    if (hn::AllFalse(df, small)) return;
    auto& t = turning_;
    Append(stored.x, small, t.gradientX + t.size);
    Append(stored.y, small, t.gradientY + t.size);
    Append(stored.z, small, t.gradientZ + t.size);
    Append(hn::Add(hn::Iota(DI(), 0), SetI(n)), small, t.waiting + t.size);
    t.size += int(hn::CountTrue(df, small));
  }

  /// Gives what turns over the mean colour along its interval, if the gradient goes straight there.
  HWY_INLINE void LightTurning() {
    const DF df;
    const auto& s = waiting_;
    auto& t = turning_;
    hn::StoreU(hn::Zero(DI()), DI(), t.waiting + t.size);
    for (int n = 0; n < t.size; n += kLanes) {
      const VI which = hn::Load(DI(), t.waiting + n);
      const auto of = [&](const float* values) { return hn::GatherIndex(df, values, which); };
      const V3 place{of(s.x), of(s.y), of(s.z)};
      const VI ray = hn::GatherIndex(DI(), s.ray, which);
      const V3 reach = Scale(MoveOf(rays_, ray), of(s.reach));
      const V3 before = GradientAt(grid_.Clamped(Add(place, Scale(reach, Set(-1))))),
               behind = GradientAt(grid_.Clamped(Add(place, reach)));
      const V3 stored{hn::Load(df, t.gradientX + n), hn::Load(df, t.gradientY + n),
                      hn::Load(df, t.gradientZ + n)};
      const V3 mean =
          matter_.ColourBetween(hn::GatherIndex(DI(), s.segment, which), of(s.density), before, behind, ray);
      HWY_ALIGN float lit[4 * kLanes];
      hn::StoreInterleaved4(mean.x, mean.y, mean.z,
                            hn::IfThenElseZero(matter_.IsStraight(before, stored, behind), Set(1)), df, lit);
      for (int m = 0; m < std::min(kLanes, t.size - n); ++m)
        if (lit[4 * m + 3] != 0) std::copy_n(lit + 4 * m, 3, lit_ + 4 * t.waiting[n + m]);
    }
    t.size = 0;
  }

  HWY_INLINE void AddToRay(int n) {
    const hn::CappedTag<float, 4> d4;
    for (int c = 0; c < 4; c += int(hn::MaxLanes(d4))) {
      float* sum = colour_.data() + 4 * waiting_.ray[n] + c;
      const auto part = hn::Mul(hn::Load(d4, lit_ + 4 * n + c), hn::Set(d4, waiting_.weight[n]));
      hn::StoreU(hn::Add(hn::LoadU(d4, sum), part), d4, sum);
    }
  }

  const TraceFrame& f_;
  const Grid& grid_;
  const RayRow& rays_;
  const Material& matter_;
  TraceCounts& counts_;
  Samples<kWaiting> waiting_;
  HWY_ALIGN float lit_[4 * kWaiting];  ///< colours of those: red, green, blue, 0
  std::conditional_t<kAlong, Turning, NoneTurn> turning_;
  std::vector<float> colour_;  ///< of each ray: red, green, blue, 0
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
