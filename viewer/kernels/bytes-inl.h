// Density and gradients of volumes with one or four bytes per voxel. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_BYTES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_BYTES_INL_H_
#undef VOLUMEN_KERNELS_BYTES_INL_H_
#else
#define VOLUMEN_KERNELS_BYTES_INL_H_
#endif

#include "viewer/kernels/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// One byte per voxel, without gradients.
struct Byte1Store : PairDensity<Byte1Store> {
  static constexpr WhereFew kWhereFew = WhereFew::batches;

  static HWY_INLINE void Densities(const Grid& grid, const std::int32_t* index, VI (&rows)[4]) {
    LoadEachOfFour(DI(), grid.Rows(grid.inputs().density8), index, rows);
    for (VI& row : rows)
      row = hn::Or(hn::And(row, SetI(0xff)), hn::And(hn::ShiftLeft<8>(row), SetI(0xff0000)));
  }
  template <bool>
  static HWY_INLINE void Prefetch(const Grid& grid, const std::int32_t* index, int count, int every = 1) {
    PrefetchCells(grid, grid.inputs().density8, 1, index, count, every);
  }
  template <bool>
  static HWY_INLINE void PrefetchBox(const Grid& grid, glm::vec3 low, glm::vec3 high) {
    grid.Prefetch(grid.inputs().density8, 1, low, high);
  }
};

/// Four bytes per voxel (Voxels8).
struct Byte4Store : VoxelPairs<Byte4Store> {
  static constexpr WhereFew kWhereFew = WhereFew::batches;
  static constexpr int kTimes = 256;

  static HWY_INLINE void Densities(const Grid& grid, const std::int32_t* index, VI (&rows)[4]) {
    for (int r = 0; r < 4; ++r) {
      const std::uint32_t* row = grid.inputs().voxels8 + grid.Offset(r);
      const VI voxel = LoadEach(DI(), row, index), next = LoadEach(DI(), row + 1, index);
      rows[r] = hn::Or(hn::And(hn::ShiftRight<24>(voxel), SetI(0xff)),
                       hn::And(hn::ShiftRight<8>(next), SetI(0xff0000)));
    }
  }

#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE int ComponentAt(const Grid& grid, std::size_t voxel, int n) {
    const std::uint8_t byte(grid.inputs().voxels8[voxel] >> 8 * n & 255);
    return n == 3 ? byte : std::int8_t(byte);
  }
#else
  template <int b>
  static HWY_INLINE VI PairsAt(const Grid& grid, const std::int32_t* index, int r) {
    const hn::Repartition<std::uint8_t, DI> d8;
    // Gradients go to the upper bytes, which keeps their sign. `none` yields 0.
    constexpr std::uint8_t none = 0x80;
    alignas(16) static constexpr std::uint8_t pairs[16] = {none, 0, none, 4, none, 1,    none, 5,
                                                           none, 2, none, 6, 3,    none, 7,    none};
    const auto both = hn::BitCast(d8, LoadEach<4>(DI(), grid.inputs().voxels8 + grid.Offset(r), index + b));
    return hn::BitCast(DI(), hn::TableLookupBytesOr0(both, hn::LoadDup128(d8, pairs)));
  }
#endif

  template <bool>
  static HWY_INLINE void Prefetch(const Grid& grid, const std::int32_t* index, int count, int every = 1) {
    PrefetchCells(grid, grid.inputs().voxels8, 1, index, count, every);
  }
  template <bool>
  static HWY_INLINE void PrefetchBox(const Grid& grid, glm::vec3 low, glm::vec3 high) {
    grid.Prefetch(grid.inputs().voxels8, 1, low, high);
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
