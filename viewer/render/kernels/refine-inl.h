// Cutting passages through cells where the density bends, and integrating the curve along the parts, compiled
// once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_REFINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_REFINE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_REFINE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_REFINE_INL_H_
#endif

#include <algorithm>
#include <vector>

#include "viewer/render/kernels/compact-inl.h"
#include "viewer/render/kernels/halves-inl.h"
#include "viewer/render/kernels/parts-inl.h"
#include "viewer/render/kernels/passage-inl.h"
#include "viewer/render/kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// What a passage or a part of one comes to: one sample where most of its light comes from.
struct Integrated {
  V3 place;  ///< clamped to the grid
  VF density, opacity, units;
  VF reach;  ///< steps from there to the middle between it and the nearer end
  VI ray;
};

/// Rays go cell by cell. Inside a cell the density is a cubic (DensityAlong), so nothing that lies between
/// samples is missed; each passage is integrated in two halves along each of which the density goes straight:
/// exact for any curve where it does (pre-integration; Engel, Kraus and Ertl 2001). Where it bends too much
/// for that they are cut (Parting).
template <class Store>
class Refiner {
 public:
  Refiner(const TraceFrame& f, const Grid& grid, const RayRow& rays, TraceCounts& counts)
      : f_(f),
        grid_(grid),
        rays_(rays),
        counts_(counts),
        parts_(rays),
        halves_(*f.curve, noted),
        readyHalves_(*f.curve, parts_.ready) {}

  static constexpr int kNoted = 4096 + kLanes;
  Intervals<kNoted> noted;
  using Noted = HalvesOf<Intervals<kNoted>>;

  /// Notes the passages through visible cells of those rays of the packet at ray `first` that are `open`, on
  /// the steps [from, to).
  HWY_INLINE void Walk(const Packet& p, int first, int from, int to, MF open) {
    const VI ray = hn::Add(hn::Iota(DI(), 0), SetI(first));
    auto& s = noted;
    // What is shorter than three tolerances costs more time than it saves of the error.
    const float shortest = std::max(1e-4f, 3 * f_.parting.tolerance);
    WalkCells(f_, p, from, to, open, shortest, [&](MF seen, const V3& middle, VF length) {
      AppendPlaces(middle, seen, s, s.size);
      Append(length, seen, s.steps + s.size);
      Append(ray, seen, s.ray + s.size);
      s.size += int(hn::CountTrue(DF(), seen));
    });
  }

  /// Integrates what is noted and forgets it; emit(const Integrated&, int count): front to back on each ray.
  /// `through`: of each ray, the share of light that comes through to its first noted interval, then to what
  /// lies behind its last; it must not depend on how far others have come.
  template <class Emit>
  HWY_INLINE void Draw(float* through, const Emit& emit) {
    SamplePassages();
    for (int n = 0; n < noted.size; n += Noted::kMost) {
      halves_.Take(n, std::min(Noted::kMost, noted.size - n));
      halves_.ForEach([&](int k) { SetThrough(n + k, k, through); });
      halves_.ForEach([&](int k) { SetParts(n + k, k); });
      halves_.ForEach([&](int k) {
        const Parts parts{hn::Load(DI(), first_ + k), hn::Load(DI(), second_ + k)};
        if (parts_.ready.size == 0 && parts.AreNone())
          return emit(Integrate(noted, n + k, halves_.At(k)), halves_.Count(k));
        Queue(n + k, parts);
        if (parts_.IsFull()) Flush(emit);
      });
    }
    Flush(emit);
    noted.size = 0;
  }

 private:
  /// Sets the densities of what is noted, and keeps what can be seen.
  HWY_INLINE void SamplePassages() {
    auto& s = noted;
    s.Pad();
    counts_.resampled += s.size;
    int kept = 0;
    // In short passes, as HalvesOf takes them.
    for (int begin = 0; begin < s.size; begin += Noted::kMost) {
      const int end = std::min(begin + Noted::kMost, s.size);
      for (int n = begin; n < end; n += kLanes) SampleDensities(n);
      for (int n = begin; n < end; n += kLanes) kept += KeepVisible(n, kept);
    }
    s.size = kept;
    s.Pad();
  }

  /// Sets the densities of the passages from n on, and for now as `around` how far the cubic may leave the
  /// straight lines between them.
  HWY_INLINE void SampleDensities(int n) {
    const DF df;
    auto& s = noted;
    const V3 half =
        Scale(MoveOf(rays_, hn::Load(DI(), s.ray + n)), hn::Mul(hn::Load(df, s.steps + n), Set(0.5f)));
    const Cubic density = DensityAlong<Store>(grid_, PlaceOf(s, n), half);
    hn::Store(density.At(Set(-1)), df, s.front + n);
    hn::Store(density.c0, df, s.middle + n);
    hn::Store(density.At(Set(1)), df, s.back + n);
    // The farthest that s^2 and s^3 leave them.
    hn::Store(hn::Add(hn::Mul(Set(0.25f), hn::Abs(density.c2)), hn::Mul(Set(0.385f), hn::Abs(density.c3))),
              df, s.around + n);
  }

  /// Moves what can be seen of the passages from n on to `kept`; how many.
  HWY_INLINE int KeepVisible(int n, int kept) {
    const DF df;
    auto& s = noted;
    const VF front = hn::Load(df, s.front + n), middle = hn::Load(df, s.middle + n),
             back = hn::Load(df, s.back + n), off = hn::Load(df, s.around + n);
    const VF low = hn::Min(middle, hn::Min(front, back)), high = hn::Max(middle, hn::Max(front, back));
    const Variation around = VariationBetween(*f_.curve, hn::Sub(low, off), hn::Add(high, off));
    const MF keep = hn::AndNot(around.hidden, hn::FirstN(df, std::size_t(noted.size - n)));
    if (hn::AllFalse(df, keep)) return 0;
    const VI ray = hn::Load(DI(), s.ray + n);
    const VF steps = hn::Load(df, s.steps + n);
    const V3 place = PlaceOf(s, n);
    const VF units = hn::Mul(
        hn::Mul(rays_.parallel ? Set(rays_.sharedStepMm) : hn::GatherIndex(df, rays_.stepMm.data(), ray),
                Set(f_.inverseUnitMm)),
        steps);
    AppendPlaces(place, keep, s, kept);
    Append(steps, keep, s.steps + kept);
    Append(units, keep, s.units + kept);
    Append(front, keep, s.front + kept);
    Append(middle, keep, s.middle + kept);
    Append(back, keep, s.back + kept);
    const VF within = VariationBetween(*f_.curve, low, high).change;
    Append(hn::Sub(around.change, hn::Mul(within, Set(0.9f))), keep, s.around + kept);
    Append(ray, keep, s.ray + kept);
    return int(hn::CountTrue(df, keep));
  }

  /// The share of light that may be missed in the passages from n on because straight lines pass it by.
  HWY_INLINE VF MissedAround(int n) const {
    const DF df;
    const VF share = Set(f_.parting.around);
    return hn::Mul(hn::Mul(hn::Load(df, noted.units + n), share), hn::Load(df, noted.around + n));
  }

  HWY_INLINE VF ColourVariationAt(const CurvePlace& p) const {
    const CurveTable& t = *f_.curve;
    return OnSegment(t, t.colourVariation, t.colourVariationRise, p.segment, Along(t, p.segment, p.density));
  }

  /// How often colours may turn from rising to falling along an interval, at least 1: the parts' errors then
  /// add up.
  static HWY_INLINE VF Turns(const Halves& h) {
    const VI low = hn::Min(h.a.segment, hn::Min(h.m.segment, h.b.segment)),
             high = hn::Max(h.a.segment, hn::Max(h.m.segment, h.b.segment));
    return hn::ConvertTo(DF(), hn::Max(hn::Sub(hn::Sub(high, low), SetI(1)), SetI(1)));
  }

  /// Into how many parts each half of an interval is cut; 0: it is left as it is.
  struct Parts {
    VI first, second;

    HWY_INLINE bool AreNone() const { return hn::AllTrue(DI(), hn::Eq(hn::Or(first, second), SetI(0))); }
  };
  HWY_INLINE Parts PartsOf(int n, const Halves& h, VF through) const {
    const DI di;
    const Parting& parting = f_.parting;
    const VF two = Set(2);
    const VF depth = hn::Add(h.depth1, h.depth2);
    const VF bent = hn::Abs(hn::Sub(depth, hn::Mul(h.units, MeanExtinction(*f_.curve, h.a, h.b))));
    const VF bentShare = hn::Div(hn::Mul(two, bent), hn::Max(depth, Set(1e-30f)));
    const VF around = MissedAround(n);
    const VF va = ColourVariationAt(h.a), vm = ColourVariationAt(h.m), vb = ColourVariationAt(h.b);
    const VF coloured =
        hn::Mul(hn::Sub(hn::Max(va, hn::Max(vm, vb)), hn::Min(va, hn::Min(vm, vb))), Turns(h));
    const VF change = hn::Mul(two, hn::Add(Set(parting.light), hn::Mul(Set(parting.colour), coloured)));
    const auto partsOf = [&](VF halfDepth, VF reaching) {
      const VF bends = hn::Add(hn::Mul(bentShare, halfDepth), hn::Mul(Set(0.1f), bent));
      const VF unlike = hn::Add(hn::Add(bends, around), hn::Mul(change, hn::Min(halfDepth, Set(0.5f))));
      const VF uneven = hn::Mul(unlike, reaching);
      VI parts = SetI(0);
      if (hn::AllFalse(DF(), hn::Gt(uneven, Set(8 * parting.tolerance)))) return parts;
      for (int more = 1; more < parting.most; more *= 2) {
        const VF enough = Set(8 * parting.tolerance * float(more) * float(more));
        parts = hn::IfThenElse(hn::RebindMask(di, hn::Gt(uneven, enough)), SetI(more), parts);
      }
      return parts;
    };
    return {partsOf(h.depth1, through), partsOf(h.depth2, hn::Mul(through, Through(h.depth1)))};
  }

  /// How much comes through a depth that is only estimated.
  HWY_INLINE VF Through(VF depth) const {
    return hn::Sub(Set(1), OpacityOfDepth(hn::Mul(depth, Set(f_.parting.trusted))));
  }

  // Of the intervals from n on, the k-th of those that halves_ took:

  /// Sets the light that comes through to them, and takes from `through` what they hide.
  HWY_INLINE void SetThrough(int n, int k, float* through) {
    HWY_ALIGN float left[kLanes];
    const Halves h = halves_.At(k);
    hn::Store(Through(hn::Add(h.depth1, h.depth2)), DF(), left);
    hn::Store(hn::Zero(DF()), DF(), through_ + k);
    for (int m = 0; m < halves_.Count(k); ++m) {
      float& t = through[noted.ray[n + m]];
      through_[k + m] = t;
      t *= left[m];
    }
  }

  /// Sets into how many parts their halves are cut.
  HWY_INLINE void SetParts(int n, int k) {
    const Parts parts = PartsOf(n, halves_.At(k), hn::Load(DF(), through_ + k));
    hn::Store(parts.first, DI(), first_ + k);
    hn::Store(parts.second, DI(), second_ + k);
  }

  HWY_INLINE void Queue(int n, const Parts& parts) {
    const int count = std::min(kLanes, noted.size - n);
    if (parts.AreNone()) {
      parts_.AddWhole(noted, n, count);
      return;
    }
    HWY_ALIGN std::int32_t first[kLanes], second[kLanes];
    hn::Store(parts.first, DI(), first);
    hn::Store(parts.second, DI(), second);
    for (int m = 0; m < count;) {
      int whole = 0;
      while (m + whole < count && first[m + whole] + second[m + whole] == 0) ++whole;
      if (whole > 0) parts_.AddWhole(noted, n + m, whole);
      m += whole;
      if (m == count) break;
      parts_.Add(noted, n + m, first[m], second[m]);
      ++m;
    }
  }

  /// Integrates all parts.
  template <class Emit>
  HWY_INLINE void Flush(const Emit& emit) {
    counts_.resampled += parts_.template Sample<Store>(grid_);
    const auto& ready = parts_.ready;
    for (int n = 0; n < ready.size; n += Ready::kMost) {
      readyHalves_.Take(n, std::min(Ready::kMost, ready.size - n));
      readyHalves_.ForEach(
          [&](int k) { emit(Integrate(ready, n + k, readyHalves_.At(k)), readyHalves_.Count(k)); });
    }
    parts_.Clear();
  }

  /// Where the light that a half shows comes from, 0..1 of its length, if the extinction rises straight: at
  /// which share of its depth light comes from in the mean, and where that is reached.
  static HWY_INLINE VF Centroid(const CurvePlace& a, const CurvePlace& b, VF depth, VF opacity) {
    const VF one = Set(1), half = Set(0.5f);
    const MF thin = hn::Lt(depth, Set(0.05f));
    // 1 / depth - (1 - opacity) / opacity.
    const VF closed = hn::Div(hn::Sub(opacity, hn::Mul(hn::Sub(one, opacity), depth)),
                              hn::IfThenElse(thin, one, hn::Mul(depth, opacity)));
    const VF share = hn::IfThenElse(thin, hn::Sub(half, hn::Mul(depth, Set(1.0f / 12))), closed);
    const VF e1 = a.extinction, twice = hn::Mul(share, hn::Add(e1, b.extinction));
    const VF root = hn::Sqrt(hn::Add(hn::Mul(e1, e1), hn::Mul(hn::Sub(b.extinction, e1), twice)));
    const VF below = hn::Add(e1, root);
    const MF none = hn::Le(below, hn::Zero(DF()));
    return hn::IfThenElse(none, half, hn::Min(one, hn::Div(twice, hn::IfThenElse(none, one, below))));
  }

  template <class Array>
  HWY_INLINE Integrated Integrate(const Array& s, int n, const Halves& h) const {
    const DF df;
    const VF zero = hn::Zero(df);
    const VF alpha1 = OpacityOfDepth(h.depth1), alpha2 = OpacityOfDepth(h.depth2);
    const VF seen2 = hn::Mul(hn::Sub(Set(1), alpha1), alpha2), opacity = hn::Add(alpha1, seen2);
    const VF sum =
        hn::Add(hn::Mul(alpha1, hn::Sub(hn::Mul(Set(0.5f), Centroid(h.a, h.m, h.depth1, alpha1)), Set(0.5f))),
                hn::Mul(seen2, hn::Mul(Set(0.5f), Centroid(h.m, h.b, h.depth2, alpha2))));
    const VF at = hn::Div(sum, hn::IfThenElse(hn::Gt(opacity, zero), opacity, Set(1)));
    const VF further = hn::Sub(hn::IfThenElse(hn::Lt(at, zero), h.m.density, h.b.density),
                               hn::IfThenElse(hn::Lt(at, zero), h.a.density, h.m.density));
    const VF density = hn::Add(h.m.density, hn::Mul(hn::Add(at, at), further));
    const VI ray = hn::Load(DI(), s.ray + n);
    const VF steps = hn::Load(df, s.steps + n);
    const V3 place = Add(PlaceOf(s, n), Scale(MoveOf(rays_, ray), hn::Mul(at, steps)));
    const VF reach = hn::Mul(hn::Sub(Set(0.25f), hn::Mul(Set(0.5f), hn::Abs(at))), steps);
    return {grid_.Clamped(place), density, opacity, h.units, reach, ray};
  }

  const TraceFrame& f_;
  const Grid& grid_;
  const RayRow& rays_;
  TraceCounts& counts_;
  PartQueue parts_;
  using Ready = HalvesOf<Intervals<PartQueue::kReady>>;
  Noted halves_;
  Ready readyHalves_;
  // Of those taken: the light that comes through to each; into how many parts its halves are cut.
  HWY_ALIGN float through_[Noted::kMost];
  HWY_ALIGN std::int32_t first_[Noted::kMost], second_[Noted::kMost];
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
