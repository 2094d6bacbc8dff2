// Composite kernel for plain steps that fetches gradients separately, only where opacity counts. Compiled
// once per CPU target.
#if defined(VOLUMEN_KERNELS_SPARSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_SPARSE_INL_H_
#undef VOLUMEN_KERNELS_SPARSE_INL_H_
#else
#define VOLUMEN_KERNELS_SPARSE_INL_H_
#endif

#include "viewer/kernels/dense-inl.h"
#include "viewer/kernels/light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Composites many packets in passes, so that no step waits for another and few branches are mispredicted.
/// Passes: find positions, densities in visible blocks, opacities of visible samples, weights per ray,
/// gradient and light of samples that count. Each pass works on whole vectors. Samples are computed and added
/// to their rays exactly as in DenseTracer, so both give the same bytes.
template <class Store, bool kIsLit, bool kGradientOpacity>
class SparseTracer {
  using Material = ClassifyAndLight<kIsLit, kGradientOpacity>;

 public:
  static constexpr int kGroupSteps = 4;  ///< Longer groups would sample more that the same group hides.
  static constexpr bool kCells = true;
  static constexpr bool kBlends = false;
  static constexpr bool kPrefetches = false;  ///< LightQueue prefetches gradients itself.

  /// `out` must be 0; the results are added to it.
  SparseTracer(const RayInputs& f, const RayRow& rays, const PlaneBuffer&, const TraceRow& out,
               TraceCounts& counts)
      : f_(f),
        grid_(f, f.densityRow),
        gradientGrid_(Grid::OfGradients(f)),
        rays_(rays),
        material_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        out_(out),
        light_(gradientGrid_, rays.steps.size(), material_, counts),
        counts_(counts) {}

  /// Advances the open packet at ray `first` through the steps that `bits` names: bit n stands for `step` +
  /// n.
  HWY_INLINE void Advance(const EmptySpaceSkipper&, int first, int step, std::uint64_t bits) {
    if (!bits) return;
    const VF open = hn::LoadU(DF(), out_.alpha + first);
    const MF alive = hn::Le(open, Set(1 - f_.stopTransmittance));
    const Packet p = LoadPacket(f_, rays_, first);
    for (; bits; bits &= bits - 1) {
      const int at = step + int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      Look(p, first, SampleAt(p, at), alive);
    }
    if (looked_.size > kLooked / 2) EndGroup();
  }

  void BeginGroup() {}

  /// Draws all collected samples.
  void EndGroup() {
    if (looked_.size > 0) Draw(looked_);
  }

  void Finish() { light_.Finish(out_); }

 private:
  static constexpr int kLooked = 4096 + kLanes;
  using Looked = Samples<kLooked>;

  /// Notes the samples `n` of the rays that are `alive`, in visible cells.
  HWY_INLINE void Look(const Packet& p, int first, VF n, MF alive) {
    alive = hn::And(alive, HasSample(p, n));
    const MF last = IsLast(p, n);
    const V3 place = grid_.Clamped(Position(p, n, last));
    alive = InVisibleCell(*f_.cells, alive, place);
    auto& s = looked_;
    AppendPlaces(place, alive, s, s.size);
    Append(hn::IfThenElse(last, p.lastUnitDistances, p.unitDistances), alive, s.unitDistances + s.size);
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

  /// Computes densities; keeps only the samples that can be seen.
  HWY_INLINE void Resample(Looked& s) {
    const DF df;
    s.Pad();
    counts_.resampled += s.size;
    int kept = 0;
    for (int n = 0; n < s.size; n += kLanes) {
      const V3 place = PlaceOf(s, n);
      const VF unitDistances = hn::Load(df, s.unitDistances + n);
      const VI ray = hn::Load(DI(), s.ray + n);
      const VF density = Store::Density(grid_, grid_.CellAt(place));
      const MF seen = hn::And(material_.CanBeSeen(density), hn::FirstN(df, std::size_t(s.size - n)));
      AppendPlaces(place, seen, s, kept);
      Append(unitDistances, seen, s.unitDistances + kept);
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
      const VF opacity =
          material_.CorrectedOpacityAt(segment, density, stored, hn::Load(df, s.unitDistances + n));
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

  const RayInputs& f_;
  const Grid grid_, gradientGrid_;  ///< Grids of densities and of gradients.
  const RayRow& rays_;
  Material material_;
  const TraceRow& out_;
  LightQueue<Store, kIsLit, kGradientOpacity> light_;
  TraceCounts& counts_;
  Looked looked_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
