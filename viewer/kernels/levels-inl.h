// Composite kernel for integration levels: rays go from cell to cell. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_LEVELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_LEVELS_INL_H_
#undef VOLUMEN_KERNELS_LEVELS_INL_H_
#else
#define VOLUMEN_KERNELS_LEVELS_INL_H_
#endif

#include <algorithm>
#include <type_traits>
#include <vector>

#include "viewer/kernels/compact-inl.h"
#include "viewer/kernels/integrate-inl.h"
#include "viewer/kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Passages of rays through cells, front to back on each ray.
template <int kCapacity>
struct Passages {
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity];                    ///< Middle.
  HWY_ALIGN float steps[kCapacity];                                            ///< Length.
  HWY_ALIGN float c0[kCapacity], c1[kCapacity], c2[kCapacity], c3[kCapacity];  ///< Density (Cubic).
  HWY_ALIGN float lowest[kCapacity], highest[kCapacity];  ///< Range of the cell (CellRange).
  HWY_ALIGN std::int32_t ray[kCapacity];
  int size = 0;

  /// Fills the rest of the last vector with harmless positions inside the volume.
  HWY_INLINE void Pad() {
    for (float* values : {x, y, z, steps}) hn::StoreU(hn::Zero(DF()), DF(), values + size);
    hn::StoreU(hn::Zero(DI()), DI(), ray + size);
  }
};

/// Composites the passages of many packets in passes. Passages through visible cells are collected, their
/// densities computed, and invisible ones dropped. The rest is drawn in waves: the first passage of each ray,
/// then the second of each, and so on. The light that reaches a passage is then known, and nothing behind
/// opaque passages is computed.
template <class Store, bool kIsLit, bool kGradientOpacity>
class LevelTracer {
  using Material = ClassifyAndLight<kIsLit, kGradientOpacity>;

 public:
  static constexpr int kGroupSteps = 4;  ///< Longer groups would sample more that the same group hides.
  static constexpr bool kCells = true;
  static constexpr bool kBlends = false;
  static constexpr bool kPrefetches = false;

  /// `out` must be 0; the results are added to it.
  LevelTracer(const RayInputs& f, const RayRow& rays, const PlaneBuffer&, const TraceRow& out,
              TraceCounts& counts)
      : f_(f),
        grid_(f, f.densityRow),
        gradientGrid_(Grid::OfGradients(f)),
        rays_(rays),
        material_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        integrator_(f, material_),
        out_(out),
        counts_(counts),
        met_(rays.steps.size()),
        sums_(4 * rays.steps.size() + 4) {}

  /// Advances the open packet at ray `first` through the steps that `bits` names: bit n stands for `step` +
  /// n.
  HWY_INLINE void Advance(const EmptySpaceSkipper&, int first, int step, std::uint64_t bits) {
    if (!bits) return;
    const MF open = hn::Le(hn::LoadU(DF(), out_.alpha + first), Set(1 - f_.stopTransmittance));
    const Packet p = LoadPacket(f_, rays_, first);
    const VI ray = hn::Add(hn::Iota(DI(), 0), SetI(first));
    auto& s = noted_;
    OverRuns(step, bits, [&](int from, int to) {
      WalkCells(f_, p, from, to, open, [&](MF seen, const V3& middle, VF length) {
        AppendPlaces(middle, seen, s, s.size);
        Append(length, seen, s.steps + s.size);
        Append(ray, seen, s.ray + s.size);
        s.size += int(hn::CountTrue(DF(), seen));
      });
    });
    if (s.size > kNoted / 2) EndGroup();
  }

  void BeginGroup() {}

  /// Draws all collected passages.
  void EndGroup() {
    if (noted_.size == 0) return;
    KeepVisible();
    const std::int64_t begin = Ticks();
    SortInWaves();
    for (std::size_t w = 0; w + 1 < waves_.size(); ++w) DrawWave(waves_[w], waves_[w + 1]);
    noted_.size = 0;
    counts_.shadeTicks += Ticks() - begin;
  }

  void Finish() {
    for (std::size_t n = 0; 4 * n + 4 < sums_.size(); ++n) {
      out_.red[n] = sums_[4 * n];
      out_.green[n] = sums_[4 * n + 1];
      out_.blue[n] = sums_[4 * n + 2];
      if (out_.error) out_.error[n] = sums_[4 * n + 3];
    }
  }

 private:
  static constexpr int kNoted = 4096 + 64 * kLanes;
  static constexpr int kRange = 4, kUnitDistances = 6, kThrough = 7, kRay = 8, kGradient = 9,
                       kFields = Material::kGradients ? kGradient + 12 : kGradient;

  /// Computes the densities of the collected passages and drops those that cannot be seen.
  HWY_INLINE void KeepVisible() {
    auto& s = noted_;
    s.Pad();
    counts_.resampled += s.size;
    int kept = 0;
    for (int n = 0; n < s.size; n += kLanes) kept += KeepVisible(n, kept);
    s.size = kept;
    s.Pad();
  }

  /// Moves the visible ones among the passages from n on to `kept`. Returns their number.
  HWY_INLINE int KeepVisible(int n, int kept) {
    const DF df;
    auto& s = noted_;
    const VI ray = hn::Load(DI(), s.ray + n);
    const VF steps = hn::Load(df, s.steps + n);
    const V3 place = PlaceOf(s, n);
    const Passage p = PassageAt(grid_, place, HalfOf(ray, steps));
    const Corners corners = Store::CornersOf(grid_, p.cell);
    const CellRange range{corners.Lowest(), corners.Highest()};
    const VF base = range.Base();
    const Cubic c = InterpolateAlong(corners.CountedFrom(base), p);
    const VF front = c.At(Set(-1)), back = c.At(Set(1)), bend = c.Bend();
    const VF low = hn::Sub(hn::Min(c.c0, hn::Min(front, back)), bend),
             high = hn::Add(hn::Max(c.c0, hn::Max(front, back)), bend);
    // In a cell of constant density nothing is rounded.
    const VF least = hn::Max(range.lowest, Rounded(base, low, -1)),
             most = hn::Min(range.highest, Rounded(base, high, 1));
    const MF keep =
        hn::AndNot(IsHiddenBetween(*f_.curve, least, most), hn::FirstN(df, std::size_t(s.size - n)));
    if (hn::AllFalse(df, keep)) return 0;
    AppendPlaces(place, keep, s, kept);
    Append(steps, keep, s.steps + kept);
    Append(c.c0, keep, s.c0 + kept);
    Append(c.c1, keep, s.c1 + kept);
    Append(c.c2, keep, s.c2 + kept);
    Append(c.c3, keep, s.c3 + kept);
    Append(range.lowest, keep, s.lowest + kept);
    Append(range.highest, keep, s.highest + kept);
    Append(ray, keep, s.ray + kept);
    return int(hn::CountTrue(df, keep));
  }

  /// Returns base + density, rounded up (`side` 1) or down (`side` -1).
  static HWY_INLINE VF Rounded(VF base, VF density, float side) {
    const VF sum = hn::Add(base, density);
    return hn::Add(sum, hn::Mul(hn::Abs(sum), Set(side * 1.2e-7f)));
  }

  HWY_INLINE V3 HalfOf(VI ray, VF steps) const {
    return Scale(MoveOf(rays_, ray), hn::Mul(steps, Set(0.5f)));
  }

  /// Fills order_ with the passages: the first of each ray before the second of each. waves_ gets the start
  /// of each wave.
  HWY_INLINE void SortInWaves() {
    const auto& s = noted_;
    waves_.assign(1, 0);
    for (int n = 0; n < s.size; ++n) {
      const int wave = met_[s.ray[n]]++;
      ofWave_[n] = wave;
      if (wave + 2 > int(waves_.size())) waves_.push_back(0);
      ++waves_[wave + 1];
    }
    for (std::size_t w = 1; w < waves_.size(); ++w) waves_[w] += waves_[w - 1];
    for (int n = 0; n < s.size; ++n) order_[waves_[ofWave_[n]]++] = n;
    for (std::size_t w = waves_.size() - 1; w > 0; --w) waves_[w] = waves_[w - 1];
    waves_[0] = 0;
    for (int n = 0; n < s.size; ++n) met_[s.ray[n]] = 0;
  }

  /// Draws the passages order_[begin, end), each on another ray, for the rays that still let light through.
  HWY_INLINE void DrawWave(int begin, int end) {
    const float opaque = 1 - f_.stopTransmittance;
    int open = begin;
    for (int n = begin; n < end; ++n) {
      const int passage = order_[n];
      order_[open] = passage;
      open += out_.alpha[noted_.ray[passage]] <= opaque;
    }
    const int count = open - begin;
    for (int n = 0; n < count; n += kLanes) Prepare(begin + n, n, std::min(kLanes, count - n));
    const auto load = [&](int next, MF lanes) { return Load(next, lanes); };
    const auto take = [&](VI ray, MF done, VF through, const PassageSum& sum) {
      AddToRays(ray, BitsOf(done), through, sum);
    };
    integrator_.Integrate(count, load, take, counts_.composited);
  }

  /// Fills the wave's fields from `at` on with the `count` passages from order_[first] on, at most one
  /// vector.
  HWY_INLINE void Prepare(int first, int at, int count) {
    const DF df;
    const DI di;
    const auto& s = noted_;
    const VI which = hn::IfThenElseZero(hn::FirstN(di, std::size_t(count)), hn::LoadU(di, order_ + first));
    const auto of = [&](const float* values) { return hn::GatherIndex(df, values, which); };
    const VI ray = hn::GatherIndex(di, s.ray, which);
    const VF steps = of(s.steps);
    const VF stepMm =
        rays_.parallel ? Set(rays_.sharedStepMm) : hn::GatherIndex(df, rays_.stepMm.data(), ray);
    const auto set = [&](int field, VF value) { hn::Store(value, df, wave_[field] + at); };
    set(0, of(s.c0)), set(1, of(s.c1)), set(2, of(s.c2)), set(3, of(s.c3));
    set(kRange, of(s.lowest)), set(kRange + 1, of(s.highest));
    set(kUnitDistances, hn::Mul(hn::Mul(stepMm, Set(f_.inverseUnitMm)), steps));
    set(kThrough, hn::Sub(Set(1), hn::GatherIndex(df, out_.alpha, ray)));
    set(kRay, hn::BitCast(df, ray));
    if constexpr (Material::kGradients) {
      const CubicVector g =
          GradientAlong<Store>(gradientGrid_, {of(s.x), of(s.y), of(s.z)}, HalfOf(ray, steps));
      int field = kGradient;
      for (const Cubic& c : {g.x, g.y, g.z}) {
        set(field, c.c0), set(field + 1, c.c1), set(field + 2, c.c2), set(field + 3, c.c3);
        field += 4;
      }
    }
  }

  /// Returns the passages of the wave from `next` on, one in each of `lanes`.
  HWY_INLINE LoadedPassages Load(int next, MF lanes) const {
    const auto of = [&](int field) { return Expanded(hn::LoadU(DF(), wave_[field] + next), lanes); };
    const auto cubic = [&](int field) {
      return Cubic{of(field), of(field + 1), of(field + 2), of(field + 3)};
    };
    LoadedPassages l;
    l.r.density = {cubic(0), {of(kRange), of(kRange + 1)}};
    l.r.unitDistances = of(kUnitDistances);
    l.r.ray = hn::BitCast(DI(), of(kRay));
    l.through = of(kThrough);
    if constexpr (Material::kGradients)
      l.r.gradient = {cubic(kGradient), cubic(kGradient + 4), cubic(kGradient + 8)};
    return l;
  }

  /// Adds the sums of the lanes `which` (bits) to their rays. `through`: light that reached the passage.
  HWY_INLINE void AddToRays(VI ray, std::uint32_t which, VF through, const PassageSum& sum) const {
    HWY_ALIGN float parts[4 * kLanes], alpha[kLanes];
    HWY_ALIGN std::int32_t rays[kLanes];
    const V3 c = Scale(sum.colour, through);
    hn::StoreInterleaved4(c.x, c.y, c.z, hn::Mul(sum.error, through), DF(), parts);
    hn::Store(hn::Mul(sum.opacity, through), DF(), alpha);
    hn::Store(ray, DI(), rays);
    const hn::CappedTag<float, 4> d4;
    for (; which; which &= which - 1) {
      const int n = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(which));
      out_.alpha[rays[n]] += alpha[n];
      for (int c4 = 0; c4 < 4; c4 += int(hn::MaxLanes(d4))) {
        float* p = sums_.data() + 4 * rays[n] + c4;
        hn::StoreU(hn::Add(hn::LoadU(d4, p), hn::Load(d4, parts + 4 * n + c4)), d4, p);
      }
    }
  }

  const RayInputs& f_;
  const Grid grid_, gradientGrid_;  ///< Grids of densities and of gradients.
  const RayRow& rays_;
  const Material material_;
  const PassageIntegrator<Material> integrator_;
  const TraceRow& out_;
  TraceCounts& counts_;
  Passages<kNoted> noted_;
  std::int32_t ofWave_[kNoted];
  HWY_ALIGN std::int32_t order_[kNoted];
  std::vector<std::int32_t> waves_, met_;  ///< met_: passages counted so far, per ray.
  /// Passages of a wave. The fields from 0 on hold their density (Cubic).
  HWY_ALIGN float wave_[kFields][kNoted];
  mutable std::vector<float> sums_;  ///< Per ray: red, green, blue, error.
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
