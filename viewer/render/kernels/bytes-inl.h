// Density and gradients of voxels of one byte and of four, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_BYTES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_BYTES_INL_H_
#undef VOLUMEN_RENDER_KERNELS_BYTES_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_BYTES_INL_H_
#endif

#include "viewer/render/kernels/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Densities of bytes, interpolated with integer weights as those of 16 bits; the sums are below 2^24, so
/// their floats are exact. Voxels::Densities(grid, index): the densities of voxels and their neighbours along
/// x in the lower and upper halves of the lanes.
template <class Voxels>
struct ByteDensity {
  static HWY_INLINE VF Density(const Grid& grid, const Cell& c) {
    const Weights w = WeightsOf(c);
    VI sum = hn::Zero(DI());
    for (int r = 0; r < 4; ++r)
      sum = Int16Store::AddPairs(sum, Voxels::Densities(grid, grid.Row(c, r)), w.row[r]);
    return Real(sum);
  }

  static HWY_INLINE Bounded DensityWithBounds(const Grid& grid, const Cell& c) {
    const DF df;
    const Weights w = WeightsOf(c);
    VI sum = hn::Zero(DI()), low = SetI(255), high = hn::Zero(DI());
    for (int r = 0; r < 4; ++r) {
      const VI both = Voxels::Densities(grid, grid.Row(c, r));
      sum = Int16Store::AddPairs(sum, both, w.row[r]);
      const VI first = hn::And(both, SetI(255)), second = hn::ShiftRight<16>(both);
      low = hn::Min(low, hn::Min(first, second));
      high = hn::Max(high, hn::Max(first, second));
    }
    return {Real(sum), hn::ConvertTo(df, low), hn::ConvertTo(df, high)};
  }

 protected:
  static HWY_INLINE VF Real(VI sum) { return hn::Mul(hn::ConvertTo(DF(), sum), Set(kWeightUnit)); }
};

/// A byte a voxel: no gradients.
struct Byte1Store : ByteDensity<Byte1Store> {
  static HWY_INLINE VI Densities(const Grid& grid, VI index) {
    const auto* base = reinterpret_cast<const std::int32_t*>(grid.frame().density8);
    const VI bytes = hn::GatherOffset(DI(), base, index);
    return hn::Or(hn::And(bytes, SetI(0xff)), hn::And(hn::ShiftLeft<8>(bytes), SetI(0xff0000)));
  }
};

/// Four bytes a voxel (Voxels8).
struct Byte4Store : ByteDensity<Byte4Store> {
  static HWY_INLINE VI Densities(const Grid& grid, VI index) {
    const Pair p = PairAt(grid, index);
    return hn::Or(hn::And(hn::ShiftRight<24>(p.voxel), SetI(0xff)),
                  hn::And(hn::ShiftRight<8>(p.next), SetI(0xff0000)));
  }

  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    const Weights w = WeightsOf(c);
    VI x = hn::Zero(DI()), y = x, z = x;
    for (int r = 0; r < 4; ++r) {
      const Pair p = PairAt(grid, grid.Row(c, r));
      x = Int16Store::AddPairs(x, Components<0>(p), w.row[r]);
      y = Int16Store::AddPairs(y, Components<1>(p), w.row[r]);
      z = Int16Store::AddPairs(z, Components<2>(p), w.row[r]);
    }
    return {Real(x), Real(y), Real(z)};
  }

  static HWY_INLINE Sample DensityAndGradient(const Grid& grid, const Cell& c) {
    return {Density(grid, c), Gradient(grid, c)};
  }

  /// The density has brought the same bytes.
  static HWY_INLINE void Prefetch(const Grid&, const Cell&, int) {}

 private:
  struct Pair {
    VI voxel, next;
  };
  static HWY_INLINE Pair PairAt(const Grid& grid, VI index) {
    const auto* base = reinterpret_cast<const std::int32_t*>(grid.frame().voxels8);
    return {hn::GatherIndex(DI(), base, index), hn::GatherIndex(DI(), base + grid.nextColumn(), index)};
  }

  template <int n>
  static HWY_INLINE VI Components(const Pair& p) {
    const VI voxel = hn::ShiftRight<24>(hn::ShiftLeft<24 - 8 * n>(p.voxel));
    const VI next = hn::ShiftRight<8>(hn::ShiftLeft<24 - 8 * n>(p.next));
    return hn::Or(hn::And(voxel, SetI(0xffff)), hn::And(next, SetI(-0x10000)));
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
