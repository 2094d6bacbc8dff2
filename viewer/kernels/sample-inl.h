// Density and gradients at positions in voxel space. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_SAMPLE_INL_H_
#undef VOLUMEN_KERNELS_SAMPLE_INL_H_
#else
#define VOLUMEN_KERNELS_SAMPLE_INL_H_
#endif

#include <hwy/cache_control.h>

#include "viewer/kernels/grid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Density and gradient at one position, in stored units.
struct Sample {
  VF density;
  V3 gradient;
};

/// The densities of a cell's eight voxels: rows ordered as in Grid::Offset, from first to second along x.
struct Corners {
  VF first[4], second[4];

  /// Returns the densities counted from `base`.
  HWY_INLINE Corners CountedFrom(VF base) const {
    Corners counted;
    for (int r = 0; r < 4; ++r) {
      counted.first[r] = hn::Sub(first[r], base);
      counted.second[r] = hn::Sub(second[r], base);
    }
    return counted;
  }

  /// Lower end of the range that trilinear interpolation stays within; Highest() is the upper end.
  HWY_INLINE VF Lowest() const {
    const auto ofRow = [&](int r) { return hn::Min(first[r], second[r]); };
    return hn::Min(hn::Min(ofRow(0), ofRow(1)), hn::Min(ofRow(2), ofRow(3)));
  }
  HWY_INLINE VF Highest() const {
    const auto ofRow = [&](int r) { return hn::Max(first[r], second[r]); };
    return hn::Max(hn::Max(ofRow(0), ofRow(1)), hn::Max(ofRow(2), ofRow(3)));
  }
};

/// The stored gradients at a cell's eight voxels.
struct GradientCorners {
  Corners x, y, z;
};

/// Trilinear weights of a cell's eight voxels in units of -1/32768, so that a weight of one fits into 16
/// bits. Each row of two voxels along x takes one 32-bit lane, the first voxel in its lower half. Each split
/// rounds one part and leaves the rest to the other, so the eight weights always add up to one. Constant
/// regions thus stay exactly constant (picture.md 2), and all CPU targets have the same integers.
struct Weights {
  VI row[4];  ///< (y0 z0), (y1 z0), (y0 z1), (y1 z1).
};

/// Whole numbers |x| <= 2^15, each as a float and in the lower 16 bits of an integer.
struct Whole {
  VF real;
  VI bits;
};
HWY_INLINE Whole Less(const Whole& a, const Whole& b) {
  return {hn::Sub(a.real, b.real), hn::Sub(a.bits, b.bits)};
}

HWY_INLINE Weights WeightsOf(const Cell& c) {
  const auto part = [](const Whole& whole, VF share) {
    const VF rounded = hn::Add(hn::Mul(whole.real, share), Set(kRounding));
    return Whole{hn::Sub(rounded, Set(kRounding)), hn::BitCast(DI(), rounded)};
  };
  const auto pair = [&](const Whole& whole) {
    const Whole second = part(whole, c.fx);
    return hn::Or(hn::ShiftLeft<16>(second.bits), hn::And(Less(whole, second).bits, SetI(0xffff)));
  };
  const Whole one{Set(-32768), SetI(-32768)};
  const Whole behind = part(one, c.fz), before = Less(one, behind);
  const Whole behind1 = part(behind, c.fy), before1 = part(before, c.fy);
  return {{pair(Less(before, before1)), pair(before1), pair(Less(behind, behind1)), pair(behind1)}};
}

constexpr float kWeightUnit = -1.0f / 32768;

/// How a store takes plain steps where few cells are visible: density and gradient together (BatchTracer), or
/// gradients only for visible samples (SparseTracer).
enum class WhereFew { batches, apart };

/// Density of integers of at most 16 bits, interpolated with integer weights.
/// Voxels::Densities(grid, index, rows) loads the rows of the cells at `index`. The first voxel and its
/// neighbour along x are in the lower and upper halves of the lanes.
template <class Voxels>
struct PairDensity {
#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE VI AddPairs(VI sum, VI a, VI b) {
    const auto low = [](VI v) { return int(std::int16_t(v.raw & 0xffff)); };
    const auto high = [](VI v) { return int(std::int16_t(v.raw >> 16)); };
    return VI(sum.raw + low(a) * low(b) + high(a) * high(b));
  }
#else
  static HWY_INLINE VI AddPairs(VI sum, VI a, VI b) {
    const hn::Repartition<std::int16_t, DI> d16;
    VI unused = hn::Zero(DI());
    return hn::ReorderWidenMulAccumulate(DI(), hn::BitCast(d16, a), hn::BitCast(d16, b), sum, unused);
  }
#endif

  /// Converts a weighted sum to a density. `times`: factor by which the numbers were scaled.
  static HWY_INLINE VF Real(VI sum, int times = 1) {
    return hn::Mul(hn::ConvertTo(DF(), sum), Set(kWeightUnit / float(times)));
  }

  static HWY_INLINE VF Density(const Grid& grid, const Cell& c) {
    const Weights w = WeightsOf(c);
    const CellIndices at(c);
    VI sum = hn::Zero(DI()), rows[4];
    Voxels::Densities(grid, at.lane, rows);
    for (int r = 0; r < 4; ++r) sum = AddPairs(sum, rows[r], w.row[r]);
    return Real(sum);
  }

  static HWY_INLINE Corners CornersOf(const Grid& grid, const Cell& c) {
    const CellIndices at(c);
    Corners v;
    VI rows[4];
    Voxels::Densities(grid, at.lane, rows);
    for (int r = 0; r < 4; ++r) SetRow(grid, rows[r], 1, v, r);
    return v;
  }

 protected:
  /// Sets a row of a cell from pairs of numbers scaled by `times`.
  static HWY_INLINE void SetRow(const Grid& grid, VI pairs, int times, Corners& v, int r) {
    const DF df;
    v.first[r] = hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(pairs)));
    // With one voxel along x there is no second voxel.
    v.second[r] = grid.nextColumn() ? hn::ConvertTo(df, hn::ShiftRight<16>(pairs)) : v.first[r];
    if (times == 1) return;
    v.first[r] = hn::Mul(v.first[r], Set(1 / float(times)));
    v.second[r] = hn::Mul(v.second[r], Set(1 / float(times)));
  }
};

/// Adds gradients, for voxels that hold density and gradient together. Voxels::PairsAt<b>(grid, index, r)
/// returns one block for every fourth lane from b on. A block holds the first voxel of row r and its
/// neighbour along x as (x0 x1 y0 y1 z0 z1 d0 d1). Gradients are scaled by Voxels::kTimes. Scalar code uses
/// Voxels::ComponentAt(grid, voxel, n) instead, in the order x, y, z, d.
template <class Voxels>
struct VoxelPairs : PairDensity<Voxels> {
  using Pairs = PairDensity<Voxels>;

#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE Sample DensityAndGradient(const Grid& grid, const Cell& c) {
    const Weights w = WeightsOf(c);
    const auto component = [&](int n) {
      int sum = 0;
      for (int r = 0; r < 4; ++r) {
        const std::size_t voxel(grid.Row(c, r).raw);
        const int weights = w.row[r].raw;
        sum += Voxels::ComponentAt(grid, voxel, n) * int(std::int16_t(weights & 0xffff)) +
               Voxels::ComponentAt(grid, voxel + 1, n) * int(std::int16_t(weights >> 16));
      }
      return VF(float(sum) * kWeightUnit);
    };
    return {component(3), { component(0), component(1), component(2) }};
  }

  static HWY_INLINE GradientCorners GradientCornersOf(const Grid& grid, const Cell& c) {
    GradientCorners g;
    const auto set = [&](Corners& v, int r, int n) {
      const std::size_t voxel(grid.Row(c, r).raw);
      const auto at = [&](std::size_t of) { return VF(float(Voxels::ComponentAt(grid, of, n))); };
      v.first[r] = at(voxel);
      v.second[r] = at(voxel + std::size_t(grid.nextColumn()));
    };
    for (int r = 0; r < 4; ++r) set(g.x, r, 0), set(g.y, r, 1), set(g.z, r, 2);
    return g;
  }
#else
  /// Uses four plain loads per sample, each of a voxel and its neighbour along x, which is much faster than
  /// gathers. With one voxel along x the second has weight 0. Block b of sum k holds the four components of
  /// sample 4 b + k.
  static HWY_INLINE Sample DensityAndGradient(const Grid& grid, const Cell& c) {
    const Weights w = WeightsOf(c);
    const CellIndices at(c);
    const VI sums[4] = {SumBlocks<0>(grid, at.lane, w), SumBlocks<1>(grid, at.lane, w),
                        SumBlocks<2>(grid, at.lane, w), SumBlocks<3>(grid, at.lane, w)};
    const Components sum = ComponentsOf(sums);
    constexpr int times = Voxels::kTimes;
    return {Pairs::Real(sum.density),
            {Pairs::Real(sum.x, times), Pairs::Real(sum.y, times), Pairs::Real(sum.z, times)}};
  }

  static HWY_INLINE GradientCorners GradientCornersOf(const Grid& grid, const Cell& c) {
    const CellIndices at(c);
    GradientCorners g;
    for (int r = 0; r < 4; ++r) {
      const VI pairs[4] = {
          Voxels::template PairsAt<0>(grid, at.lane, r), Voxels::template PairsAt<1>(grid, at.lane, r),
          Voxels::template PairsAt<2>(grid, at.lane, r), Voxels::template PairsAt<3>(grid, at.lane, r)};
      const Components of = ComponentsOf(pairs);
      Pairs::SetRow(grid, of.x, Voxels::kTimes, g.x, r);
      Pairs::SetRow(grid, of.y, Voxels::kTimes, g.y, r);
      Pairs::SetRow(grid, of.z, Voxels::kTimes, g.z, r);
    }
    return g;
  }

 private:
  /// The components of each lane, from four vectors: block b of the k-th holds those of lane 4 b + k.
  struct Components {
    VI x, y, z, density;
  };
  static HWY_INLINE Components ComponentsOf(const VI (&of)[4]) {
    const DI di;
    const hn::Repartition<std::int64_t, DI> d64;
    const auto low64 = [&](VI a, VI b) {
      return hn::BitCast(di, hn::InterleaveLower(d64, hn::BitCast(d64, a), hn::BitCast(d64, b)));
    };
    const auto high64 = [&](VI a, VI b) {
      return hn::BitCast(di, hn::InterleaveUpper(d64, hn::BitCast(d64, a), hn::BitCast(d64, b)));
    };
    const VI xy01 = hn::InterleaveLower(di, of[0], of[1]), xy23 = hn::InterleaveLower(di, of[2], of[3]),
             zd01 = hn::InterleaveUpper(di, of[0], of[1]), zd23 = hn::InterleaveUpper(di, of[2], of[3]);
    return {low64(xy01, xy23), high64(xy01, xy23), low64(zd01, zd23), high64(zd01, zd23)};
  }

  template <int b>
  static HWY_INLINE VI SumBlocks(const Grid& grid, const std::int32_t* index, const Weights& w) {
    VI sum = hn::Zero(DI());
    for (int r = 0; r < 4; ++r)
      sum = Pairs::AddPairs(sum, Voxels::template PairsAt<b>(grid, index, r), hn::Broadcast<b>(w.row[r]));
    return sum;
  }

 public:
#endif
  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    return DensityAndGradient(grid, c).gradient;
  }
};

/// Prefetches the `voxels` of `count` cells, or of every `every`-th cell; they lie far apart in memory.
/// `elements`: values per voxel.
template <class T>
HWY_INLINE void PrefetchCells(const Grid& grid, const T* voxels, int elements, const std::int32_t* index,
                              int count, int every) {
  for (int n = 0; n < count; n += every)
    for (int r = 0; r < 4; ++r) hwy::Prefetch(voxels + elements * (std::int64_t(index[n]) + grid.Offset(r)));
}

/// 16-bit integers. One 32-bit load brings the densities of a voxel and its neighbour along x.
struct Int16Store : VoxelPairs<Int16Store> {
  static constexpr WhereFew kWhereFew = WhereFew::batches;
  static constexpr int kTimes = 1;

  static HWY_INLINE void Densities(const Grid& grid, const std::int32_t* index, VI (&rows)[4]) {
    LoadEachOfFour(DI(), grid.Rows(grid.inputs().density16), index, rows);
    for (VI& row : rows) row = hn::Xor(row, SetI(int(grid.inputs().flip16)));
  }

#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE int ComponentAt(const Grid& grid, std::size_t voxel, int n) {
    return grid.inputs().voxels16[4 * voxel + n];
  }
#else
  template <int b>
  static HWY_INLINE VI PairsAt(const Grid& grid, const std::int32_t* index, int r) {
    using Voxel = std::int16_t[4];
    const hn::Repartition<std::uint8_t, DI> d8;
    // (x0 y0 z0 d0 x1 y1 z1 d1) -> (x0 x1 y0 y1 z0 z1 d0 d1)
    alignas(16) static constexpr std::uint8_t pairs[16] = {0, 1, 8,  9,  2, 3, 10, 11,
                                                           4, 5, 12, 13, 6, 7, 14, 15};
    const auto* row = reinterpret_cast<const Voxel*>(grid.inputs().voxels16) + grid.Offset(r);
    const auto both = hn::BitCast(d8, LoadEach<4>(DI(), row, index + b));
    return hn::BitCast(DI(), hn::TableLookupBytes(both, hn::LoadDup128(d8, pairs)));
  }
#endif

  template <bool kGradients>
  static HWY_INLINE void Prefetch(const Grid& grid, const std::int32_t* index, int count, int every = 1) {
    if constexpr (kGradients)
      PrefetchCells(grid, grid.inputs().voxels16, 4, index, count, every);
    else
      PrefetchCells(grid, grid.inputs().density16, 1, index, count, every);
  }
  template <bool kGradients>
  static HWY_INLINE void PrefetchBox(const Grid& grid, glm::vec3 low, glm::vec3 high) {
    if constexpr (kGradients)
      grid.Prefetch(grid.inputs().voxels16, 4, low, high);
    else
      grid.Prefetch(grid.inputs().density16, 1, low, high);
  }
};

struct Float32Store {
  static constexpr WhereFew kWhereFew = WhereFew::apart;

  static HWY_INLINE VF Row(const Grid& grid, VI index, VF fx) {
    const DF df;
    const float* base = grid.inputs().density32;
    return Lerp(hn::GatherIndex(df, base, index), hn::GatherIndex(df, base + grid.nextColumn(), index), fx);
  }

  static HWY_INLINE VF Density(const Grid& grid, const Cell& c) {
    const auto row = [&](int r) { return Row(grid, grid.Row(c, r), c.fx); };
    return AcrossRows(row(0), row(1), row(2), row(3), c);
  }

  static HWY_INLINE Corners CornersOf(const Grid& grid, const Cell& c) {
    const DF df;
    const float* base = grid.inputs().density32;
    Corners v;
    for (int r = 0; r < 4; ++r) {
      v.first[r] = hn::GatherIndex(df, base, grid.Row(c, r));
      v.second[r] = hn::GatherIndex(df, base + grid.nextColumn(), grid.Row(c, r));
    }
    return v;
  }

  static HWY_INLINE Sample DensityAndGradient(const Grid& grid, const Cell& c) {
    return {Density(grid, c), Gradient(grid, c)};
  }
  template <bool>
  static HWY_INLINE void Prefetch(const Grid&, const std::int32_t*, int, int = 1) {}
  template <bool kGradients>
  static HWY_INLINE void PrefetchBox(const Grid& grid, glm::vec3 low, glm::vec3 high) {
    grid.Prefetch(grid.inputs().density32, 1, low, high);
    if constexpr (kGradients) grid.Prefetch(grid.inputs().gradients32, 4, low, high);
  }

  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    return InterpolateFour(grid, c, grid.inputs().gradients32).xyz;
  }

  static HWY_INLINE GradientCorners GradientCornersOf(const Grid& grid, const Cell& c) {
    using Voxel = float[4];
    const auto* voxels = reinterpret_cast<const Voxel*>(grid.inputs().gradients32);
    const CellIndices at(c);
    GradientCorners g;
    for (int r = 0; r < 4; ++r) {
      const Voxel* row = voxels + grid.Offset(r);
      const FourEach first = LoadFourEach(row, at.lane),
                     second = LoadFourEach(row + grid.nextColumn(), at.lane);
      g.x.first[r] = first.a, g.y.first[r] = first.b, g.z.first[r] = first.c;
      g.x.second[r] = second.a, g.y.second[r] = second.b, g.z.second[r] = second.c;
    }
    return g;
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
