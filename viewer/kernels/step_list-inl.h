// Composites samples of many rays, collected step by step. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_STEP_LIST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_STEP_LIST_INL_H_
#undef VOLUMEN_KERNELS_STEP_LIST_INL_H_
#else
#define VOLUMEN_KERNELS_STEP_LIST_INL_H_
#endif

#include "viewer/kernels/compact-inl.h"
#include "viewer/kernels/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The packets and steps that collected samples belong to, in the order of the samples.
template <int kMost, int kMostSteps>
struct StepList {
  struct Step {
    int first;           ///< First ray of the packet.
    int number;          ///< Number of the step in the row.
    std::uint32_t rays;  ///< The rays of the packet that have a sample at this step, as bits.
  };
  Step steps[kMostSteps];
  int stepCount = 0;
  int noted = 0;  ///< Number of samples before invisible ones are removed.
  /// Mask of the visible ones among the `noted` samples, one vector per entry.
  std::uint32_t seen[kMost / kLanes + 1];

  /// Returns one vector's worth of the bits in `seen`, with the bit of sample n lowest.
  HWY_INLINE std::uint32_t SeenFrom(int n) const {
    const std::uint64_t next = seen[n / kLanes + 1];
    return std::uint32_t((seen[n / kLanes] | next << kLanes) >> n % kLanes);
  }
};

/// Replaces positions of samples by their cells and the positions there, and prefetches the voxels.
template <class Store, bool kGradients, class Samples>
HWY_INLINE void LocateSamples(const Grid& grid, Samples& s) {
  const DF df;
  for (int n = 0; n < s.size; n += kLanes) {
    const Cell c = grid.CellAt(grid.Clamped(PlaceOf(s, n)));
    hn::Store(c.index, DI(), s.index + n);
    hn::Store(c.fx, df, s.x + n);
    hn::Store(c.fy, df, s.y + n);
    hn::Store(c.fz, df, s.z + n);
    // Prefetches every fourth cell: the cells between are neighbours, mostly in the same cache lines.
    Store::template Prefetch<kGradients>(grid, s.index + n, kLanes, 4);
  }
}

/// The sums of a packet's rays, loaded from a row and written back at the end.
struct PacketSums {
  VF red, green, blue, alpha;

  HWY_INLINE PacketSums(const TraceRow& row, int first) : row_(row), first_(first) {
    const auto load = [&](const float* values) { return hn::LoadU(DF(), values + first); };
    red = load(row.red), green = load(row.green), blue = load(row.blue), alpha = load(row.alpha);
  }
  /// Adds samples behind the others (paper 3.1). Returns the rays to which they add anything.
  HWY_INLINE MF Add(const V3& colour, VF opacity) {
    const VF weight = hn::Mul(hn::Sub(Set(1), alpha), opacity);
    red = hn::Add(red, hn::Mul(colour.x, weight));
    green = hn::Add(green, hn::Mul(colour.y, weight));
    blue = hn::Add(blue, hn::Mul(colour.z, weight));
    alpha = hn::Add(alpha, weight);
    return hn::Gt(weight, hn::Zero(DF()));
  }
  HWY_INLINE void Keep() const {
    const auto store = [&](VF v, float* values) { hn::StoreU(v, DF(), values + first_); };
    store(red, row_.red), store(green, row_.green), store(blue, row_.blue), store(alpha, row_.alpha);
  }

 private:
  const TraceRow& row_;
  int first_;
};

/// Composites visible samples front to back. Their colours are `s.x`, `s.y` and `s.z`. With `kNested`,
/// every other sample is also composited into `coarse`, as if its step were twice as long.
template <bool kNested, class List>
HWY_INLINE void CompositeSteps(const RayInputs& f, const List& s, const float* opacities, const TraceRow& out,
                               const TraceRow& coarse, TraceCounts& counts) {
  const DF df;
  const VF opaque = Set(1 - f.stopTransmittance);
  int at = 0, noted = 0;
  for (int k = 0; k < s.stepCount;) {
    const int first = s.steps[k].first;
    PacketSums sums(out, first), coarseSums(kNested ? coarse : out, first);
    for (; k < s.stepCount && s.steps[k].first == first; ++k) {
      const std::uint32_t rays = s.steps[k].rays, seen = Deposited(s.SeenFrom(noted), rays);
      noted += int(hwy::PopCount(rays));
      if (!seen) continue;
      const MF has = MaskOf(seen);
      const auto expanded = [&](const float* v) { return Expanded(hn::LoadU(df, v + at), has); };
      const V3 colour{expanded(s.x), expanded(s.y), expanded(s.z)};
      const VF opacity = hn::IfThenElseZero(hn::Le(sums.alpha, opaque), expanded(opacities));
      counts.composited += std::int64_t(hn::CountTrue(df, sums.Add(colour, opacity)));
      // 1 - (1 - opacity)^2
      if (kNested && s.steps[k].number % 2 == 0)
        coarseSums.Add(colour, hn::Mul(opacity, hn::Sub(Set(2), opacity)));
      at += int(hwy::PopCount(seen));
    }
    sums.Keep();
    if constexpr (kNested) coarseSums.Keep();
  }
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
