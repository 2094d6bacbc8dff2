// The composite kernel that fetches gradients where opacity counts, of levels and where few samples of plain
// steps are visible, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_
#endif

#include "viewer/render/kernels/dense-inl.h"
#include "viewer/render/kernels/light-inl.h"
#include "viewer/render/kernels/refine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// In passes over many packets, so that no step waits for another and few branches are guessed wrong: where
/// to look; densities of what lies in visible blocks; opacities of what can be seen; weights, ray by ray;
/// gradient and light of what counts. Each pass works on whole vectors. Every sample is computed as
/// DenseTracer does, and added to its ray in the same order, so both give the same bytes.
template <class Store, ShadeBy kShade, bool kGradientOpacity, bool kRefined>
class SparseTracer {
  using Material = Matter<kShade, kGradientOpacity>;
  static constexpr bool kLitAlong = kRefined && kShade != ShadeBy::nothing;

 public:
  static constexpr int kSlab = 4;  ///< steps; in longer slabs more is looked at that the same slab hides
  static constexpr bool kCells = true;
  static constexpr bool kBlends = false;
  static constexpr bool kPrefetches = false;  ///< LightQueue asks for gradients alone

  /// Adds to `out`, which must be 0.
  SparseTracer(const TraceFrame& f, const RayRow& rays, const PlaneBuffer&, const TraceRow& out,
               TraceCounts& counts)
      : f_(f),
        grid_(f, f.densityRow),
        gradientGrid_(f, f.gradientRow),
        rays_(rays),
        matter_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        out_(out),
        light_(f, gradientGrid_, rays, matter_, counts),
        counts_(counts),
        refiner_(f, grid_, rays, counts) {}

  /// Takes the packet at ray `first`, which is open, through the steps [step, end) that `bits` names, step +
  /// n by bit n.
  HWY_INLINE void Advance(const Skipper&, int first, int step, std::uint64_t bits) {
    if (!bits) return;
    const VF open = hn::LoadU(DF(), out_.alpha + first);
    const MF alive = hn::Le(open, Set(1 - f_.stopTransmittance));
    const Packet p = LoadPacket(f_, rays_, first);
    if constexpr (kRefined) {
      OverRuns(step, bits, [&](int from, int to) { refiner_.Walk(p, first, from, to, alive); });
    } else {
      for (; bits; bits &= bits - 1) {
        const int at = step + int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
        Look(p, first, SampleAt(p, at), alive);
      }
    }
    if (Noted() > kLooked / 2) EndSlab();
  }

  void BeginSlab() {
    // What the slab's intervals are parted by must not depend on how far others of the slab have come.
    if constexpr (kRefined) {
      through_.resize(rays_.steps.size());
      for (std::size_t n = 0; n < through_.size(); ++n) through_[n] = 1 - out_.alpha[n];
    }
  }

  /// Draws all that was noted.
  void EndSlab() {
    if (Noted() == 0) return;
    if constexpr (kRefined)
      Refine();
    else
      Draw(looked_);
  }

  void Finish() { light_.Finish(out_); }

 private:
  static constexpr int kLooked = Refiner<Store>::kNoted;
  using Looked = Samples<kLooked>;
  struct NotRefined {
    NotRefined(const TraceFrame&, const Grid&, const RayRow&, TraceCounts&) {}
  };

  int Noted() const {
    if constexpr (kRefined)
      return refiner_.noted.size;
    else
      return looked_.size;
  }

  /// Notes the samples `n` of those rays that are `alive` and have them.
  HWY_INLINE void Look(const Packet& p, int first, VF n, MF alive) {
    alive = hn::And(alive, HasSample(p, n));
    const MF last = IsLast(p, n);
    const V3 place = grid_.Clamped(Position(p, n, last));
    alive = InVisibleCell(*f_.cells, alive, place);
    auto& s = looked_;
    AppendPlaces(place, alive, s, s.size);
    Append(hn::IfThenElse(last, p.lastUnits, p.units), alive, s.units + s.size);
    Append(hn::Add(hn::Iota(DI(), 0), SetI(first)), alive, s.ray + s.size);
    s.size += int(hn::CountTrue(DF(), alive));
  }

  HWY_INLINE void Draw(Looked& s) {
    Resample(s);
    Classify(s);
    Composite(s);
    for (int n = 0; n < s.size; n += kLanes) light_.Take(s, n);
    s.size = 0;
  }

  /// Integrates the intervals that were noted and draws them.
  HWY_INLINE void Refine() {
    refiner_.Draw(through_.data(), [&](const Integrated& part, int count) {
      const MF counts = hn::And(hn::Gt(part.opacity, hn::Zero(DF())), hn::FirstN(DF(), std::size_t(count)));
      auto& s = looked_;
      AppendPlaces(part.place, counts, s, s.size);
      Append(part.units, counts, s.units + s.size);
      Append(part.reach, counts, s.reach + s.size);
      Append(part.density, counts, s.density + s.size);
      Append(part.opacity, counts, s.weight + s.size);
      Append(part.ray, counts, s.ray + s.size);
      s.size += int(hn::CountTrue(DF(), counts));
      if (s.size > kLooked - 2 * kLanes) DrawIntegrated(s);
    });
    DrawIntegrated(looked_);
  }

  HWY_INLINE void DrawIntegrated(Looked& s) {
    const DF df;
    s.Pad();
    for (int n = 0; n < s.size; n += kLanes) {
      hn::Store(SegmentOf(*f_.curve, hn::Load(df, s.density + n)), DI(), s.segment + n);
      if constexpr (kGradientOpacity) {
        // The mean opacity a unit, times the factor where most of the light comes from.
        const VF units = hn::Load(df, s.units + n), opacity = hn::Load(df, s.weight + n);
        const VF mean = IntervalOpacity(opacity, hn::Div(Set(1), hn::Max(units, Set(1e-30f))));
        const VF factor = matter_.FactorAt(GradientAt(s, n));
        const VF scaled = IntervalOpacity(hn::Mul(mean, factor), units);
        hn::Store(hn::IfThenElse(hn::Eq(factor, Set(1)), opacity, scaled), df, s.weight + n);
      }
    }
    Composite(s);
    for (int n = 0; n < s.size; n += kLanes) light_.Take(s, n);
    s.size = 0;
  }

  /// Densities; keeps the samples that can be seen.
  HWY_INLINE void Resample(Looked& s) {
    const DF df;
    s.Pad();
    counts_.resampled += s.size;
    int kept = 0;
    for (int n = 0; n < s.size; n += kLanes) {
      const V3 place = PlaceOf(s, n);
      const VF units = hn::Load(df, s.units + n);
      const VI ray = hn::Load(DI(), s.ray + n);
      const VF density = Store::Density(grid_, grid_.CellAt(place));
      const MF seen = hn::And(matter_.CanBeSeen(density), hn::FirstN(df, std::size_t(s.size - n)));
      AppendPlaces(place, seen, s, kept);
      Append(units, seen, s.units + kept);
      Append(ray, seen, s.ray + kept);
      Append(density, seen, s.density + kept);
      kept += int(hn::CountTrue(df, seen));
    }
    s.size = kept;
    s.Pad();
  }

  HWY_INLINE void Classify(Looked& s) {
    const DF df;
    for (int n = 0; n < s.size; n += kLanes) {
      const VF density = hn::Load(df, s.density + n);
      const VI segment = SegmentOf(*f_.curve, density);
      V3 stored = Zero3();
      if constexpr (kGradientOpacity) stored = GradientAt(s, n);
      hn::Store(segment, DI(), s.segment + n);
      const VF opacity = matter_.IntervalOpacityAt(segment, density, stored, hn::Load(df, s.units + n));
      hn::Store(opacity, df, s.weight + n);
    }
  }

  HWY_INLINE void Composite(Looked& s) {
    const float opaque = 1 - f_.stopTransmittance;
    for (int n = 0; n < s.size; ++n) {
      float& alpha = out_.alpha[s.ray[n]];
      const float weight = alpha <= opaque ? (1 - alpha) * s.weight[n] : 0.0f;
      s.weight[n] = weight;
      alpha += weight;
    }
  }

  HWY_INLINE V3 GradientAt(const Looked& s, int n) const {
    return Store::Gradient(gradientGrid_, gradientGrid_.CellAt(PlaceOf(s, n)));
  }

  const TraceFrame& f_;
  const Grid grid_, gradientGrid_;  ///< of densities; of gradients
  const RayRow& rays_;
  Material matter_;
  const TraceRow& out_;
  LightQueue<Store, kShade, kGradientOpacity, kLitAlong> light_;
  TraceCounts& counts_;
  Looked looked_;
  std::conditional_t<kRefined, Refiner<Store>, NotRefined> refiner_;
  std::vector<float> through_;  ///< of each ray, the light that comes through to what is not noted yet
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
