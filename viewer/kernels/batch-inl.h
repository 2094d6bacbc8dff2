// Composite kernel for plain steps that samples only visible cells. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_BATCH_INL_H_
#undef VOLUMEN_KERNELS_BATCH_INL_H_
#else
#define VOLUMEN_KERNELS_BATCH_INL_H_
#endif

#include <cmath>
#include <utility>
#include <vector>

#include "viewer/kernels/cells-inl.h"
#include "viewer/kernels/sample_arrays-inl.h"
#include "viewer/kernels/step_list-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Composites the samples of several packets that lie in visible cells. A batch holds samples of any rays.
/// Passes over a batch: density and gradient together, opacity and light of the samples that can be seen,
/// then compositing per ray. The voxels of the next batch are prefetched while one batch is computed. Samples
/// are computed and added to their rays exactly as in DenseTracer, so both give the same bytes.
template <class Store, bool kIsLit, bool kGradientOpacity, bool kNested = false>
class BatchTracer {
  using Material = ClassifyAndLight<kIsLit, kGradientOpacity>;

 public:
  /// Steps that all packets take before any packet takes the next group.
  static constexpr int kGroupSteps = 16;
  static constexpr bool kCells = true;
  static constexpr bool kPrefetches = false;
  static constexpr bool kBlends = false;

  /// `out` must be 0; the results are added to it.
  BatchTracer(const RayInputs& f, const RayRow& rays, const PlaneBuffer&, const TraceRow& out,
              TraceCounts& counts)
      : f_(f),
        grid_(Material::kGradients ? Grid::OfGradients(f) : Grid(f, f.densityRow)),
        rays_(rays),
        material_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        out_(out),
        counts_(counts),
        coarseValues_(kNested ? 4 * rays.steps.size() : 0) {
    const std::size_t n = coarseValues_.size() / 4;
    float* values = coarseValues_.data();
    coarse_ = {values, values + n, values + 2 * n, values + 3 * n};
  }

  /// Advances the open packet at ray `first` through the steps that `bits` names: bit n stands for `step` +
  /// n.
  HWY_INLINE void Advance(const EmptySpaceSkipper& skipper, int first, int step, std::uint64_t bits) {
    if (!bits) return;
    const Packet p = LoadPacket(f_, rays_, first);
    const MF open = hn::Le(hn::LoadU(DF(), out_.alpha + first), Set(1 - f_.stopTransmittance));
    const Windows windows(*f_.cells, skipper, step);
    if (GoOn(p, open, step, kGroupSteps))
      Place<true>(p, open, windows, first, step, bits);
    else
      Place<false>(p, open, windows, first, step, bits);
    if (next_->size < kFull) return;
    Locate(*next_);
    std::swap(next_, batch_);
    Draw(*next_);
  }
  void BeginGroup() {}
  void EndGroup() {
    Locate(*next_);
    Draw(*batch_);
    Draw(*next_);
  }
  void Finish() {
    if constexpr (kNested)
      for (std::size_t n = 0; n < rays_.steps.size(); ++n)
        out_.error[n] =
            std::max({std::abs(out_.red[n] - coarse_.red[n]), std::abs(out_.green[n] - coarse_.green[n]),
                      std::abs(out_.blue[n] - coarse_.blue[n]), std::abs(out_.alpha[n] - coarse_.alpha[n])});
  }

 private:
  static constexpr int kFull = 8 * kLanes;
  using Windows = CellWindows<kGroupSteps>;

  static constexpr bool kRays = Material::kLit;  ///< Lighting may need the ray of each sample.

  static constexpr int kMost = kFull + (kGroupSteps + 1) * kLanes, kMostSteps = kFull + kGroupSteps;
  /// Samples, and the steps they belong to.
  struct Batch : SampleArrays<kMost>, StepList<kMost, kMostSteps> {
    HWY_ALIGN std::int32_t ray[kRays ? kMost : 1];
    /// Fills the last vector with samples of length 0.
    HWY_INLINE void Pad() {
      const int end = this->size;
      for (float* values : {this->x, this->y, this->z, this->unitDistances})
        hn::StoreU(hn::Zero(DF()), DF(), values + end);
      if constexpr (kRays) hn::StoreU(hn::Zero(DI()), DI(), ray + end);
    }
  };

  /// Notes the packet's samples in visible cells. `kGoOn`: GoOn holds for the open rays.
  template <bool kGoOn>
  HWY_INLINE void Place(const Packet& p, MF open, const Windows& windows, int first, int step,
                        std::uint64_t bits) {
    const auto placeAt = [&](VF n) {
      if constexpr (kGoOn)
        return PositionBefore(p, n);
      else
        return Position(p, n, IsLast(p, n));
    };
    auto& s = *next_;
    // Tests all steps before noting any, so that no step waits for the result of the one before.
    std::uint32_t masks[kGroupSteps];
    std::uint64_t visible = 0;
    for (; bits; bits &= bits - 1) {
      const int k = int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      const VF n = SampleAt(p, step + k);
      const V3 place = placeAt(n);
      const MF there = kGoOn ? open : hn::And(open, HasSample(p, n));
      masks[k] = BitsOf(windows.fits(k) ? windows.IsVisible(k, there, place)
                                        : InVisibleCell(*f_.cells, there, grid_.Clamped(place)));
      visible |= std::uint64_t(masks[k] != 0) << k;
    }
    for (; visible; visible &= visible - 1) {
      const int k = int(hwy::Num0BitsBelowLS1Bit_Nonzero64(visible));
      const VF n = SampleAt(p, step + k);
      const MF has = MaskOf(masks[k]);
      s.steps[s.stepCount++] = {first, step + k, masks[k]};
      const VF unitDistances =
          kGoOn ? p.unitDistances : hn::IfThenElse(IsLast(p, n), p.lastUnitDistances, p.unitDistances);
      Append(unitDistances, has, s.unitDistances + s.size);
      AppendPlaces(placeAt(n), has, s, s.size);
      if constexpr (kRays) Append(hn::Iota(DI(), first), has, s.ray + s.size);
      s.size += int(hwy::PopCount(masks[k]));
    }
  }

  /// Finds the cells of the samples and prefetches their voxels.
  HWY_INLINE void Locate(Batch& s) {
    s.noted = s.size;
    s.Pad();
    LocateSamples<Store, Material::kGradients>(grid_, s);
  }

  HWY_INLINE void Draw(Batch& s) {
    if (s.noted == 0) return;
    counts_.resampled += s.noted;
    Resample(s);
    Classify(material_, s);
    // Times one batch in 32 and extrapolates to all.
    const std::int64_t begin = timed_++ % 32 == 0 ? Ticks() : 0;
    Light(material_, s, [&](int n) {
      if constexpr (kRays)
        return hn::Load(DI(), s.ray + n);
      else
        return hn::Zero(DI());
    });
    CompositeSteps<kNested>(f_, s, s.unitDistances, out_, coarse_, counts_);
    if (begin) counts_.shadeTicks += 32 * (Ticks() - begin);
    s.size = s.noted = s.stepCount = 0;
  }

  /// Computes densities and gradients; keeps only the samples that can be seen.
  HWY_INLINE void Resample(Batch& s) {
    const DF df;
    int kept = 0;
    for (int n = 0; n < s.noted; n += kLanes) {
      const V3 place = PlaceOf(s, n);
      const Cell c{hn::Load(DI(), s.index + n), place.x, place.y, place.z};
      Sample x;
      if constexpr (Material::kGradients)
        x = Store::DensityAndGradient(grid_, c);
      else
        x = {Store::Density(grid_, c), Zero3()};
      const VF unitDistances = hn::Load(df, s.unitDistances + n);
      const MF seen = hn::And(hn::Gt(unitDistances, hn::Zero(df)), material_.CanBeSeen(x.density));
      s.seen[n / kLanes] = BitsOf(seen);
      Append(unitDistances, seen, s.unitDistances + kept);
      Append(x.density, seen, s.density + kept);
      if constexpr (Material::kGradients) AppendPlaces(x.gradient, seen, s, kept);
      if constexpr (kRays) Append(hn::Load(DI(), s.ray + n), seen, s.ray + kept);
      kept += int(hwy::PopCount(s.seen[n / kLanes]));
    }
    s.size = kept;
    hn::StoreU(hn::Zero(df), df, s.unitDistances + kept);
  }

  const RayInputs& f_;
  const Grid grid_;
  const RayRow& rays_;
  Material material_;
  const TraceRow& out_;
  TraceCounts& counts_;
  std::vector<float> coarseValues_;
  TraceRow coarse_{};  ///< Results of steps of twice the length.
  Batch batches_[2];
  Batch *batch_ = &batches_[0], *next_ = &batches_[1];
  unsigned timed_ = 0;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
