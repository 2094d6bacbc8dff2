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

/// A byte a voxel: no gradients.
struct Byte1Store : PairDensity<Byte1Store> {
  static constexpr WhereFew kWhereFew = WhereFew::dense;

  static HWY_INLINE void Densities(const Grid& grid, const std::int32_t* index, VI (&rows)[4]) {
    LoadEachOfFour(DI(), grid.Rows(grid.frame().density8), index, rows);
    for (VI& row : rows)
      row = hn::Or(hn::And(row, SetI(0xff)), hn::And(hn::ShiftLeft<8>(row), SetI(0xff0000)));
  }
  template <bool>
  static HWY_INLINE void PrefetchBox(const Grid& grid, glm::vec3 low, glm::vec3 high) {
    grid.Prefetch(grid.frame().density8, 1, low, high);
  }
};

/// Four bytes a voxel (Voxels8).
struct Byte4Store : PairDensity<Byte4Store> {
  static constexpr WhereFew kWhereFew = WhereFew::apart;

  static HWY_INLINE void Densities(const Grid& grid, const std::int32_t* index, VI (&rows)[4]) {
    for (int r = 0; r < 4; ++r) {
      const Pair p = PairAt(grid, index, grid.Offset(r));
      rows[r] = hn::Or(hn::And(hn::ShiftRight<24>(p.voxel), SetI(0xff)),
                       hn::And(hn::ShiftRight<8>(p.next), SetI(0xff0000)));
    }
  }

  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    const Weights w = WeightsOf(c);
    const CellIndices at(c);
    VI x = hn::Zero(DI()), y = x, z = x;
    for (int r = 0; r < 4; ++r) {
      const Pair p = PairAt(grid, at.lane, grid.Offset(r));
      x = AddPairs(x, Components<0>(p), w.row[r]);
      y = AddPairs(y, Components<1>(p), w.row[r]);
      z = AddPairs(z, Components<2>(p), w.row[r]);
    }
    return {Real(x), Real(y), Real(z)};
  }

  static HWY_INLINE Sample DensityAndGradient(const Grid& grid, const Cell& c) {
    return {Density(grid, c), Gradient(grid, c)};
  }

  /// The density has brought the same bytes.
  template <bool>
  static HWY_INLINE void Prefetch(const Grid&, const std::int32_t*, int) {}
  template <bool>
  static HWY_INLINE void PrefetchBox(const Grid& grid, glm::vec3 low, glm::vec3 high) {
    grid.Prefetch(grid.frame().voxels8, 1, low, high);
  }

 private:
  struct Pair {
    VI voxel, next;
  };
  static HWY_INLINE Pair PairAt(const Grid& grid, const std::int32_t* index, int offset) {
    const std::uint32_t* base = grid.frame().voxels8 + offset;
    return {LoadEach(DI(), base, index), LoadEach(DI(), base + grid.nextColumn(), index)};
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
