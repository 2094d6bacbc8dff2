// Tests whether samples lie in visible cells. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_CELLS_INL_H_
#undef VOLUMEN_KERNELS_CELLS_INL_H_
#else
#define VOLUMEN_KERNELS_CELLS_INL_H_
#endif

#include "viewer/kernels/compact-inl.h"
#include "viewer/kernels/empty_space-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Returns the bit of a cell in its word (VisibleCells::words).
HWY_INLINE VI BitOfCell(VI x, VI y, VI z) {
  const VI ofRow = hn::OrAnd(hn::And(x, SetI(3)), hn::ShiftLeft<2>(y), SetI(12));
  return hn::Shl(SetI(1), hn::OrAnd(ofRow, hn::ShiftLeft<4>(z), SetI(16)));
}

/// Returns the index of the block of cells at block coordinates (x, y, z).
HWY_INLINE VI BlockAt(const VisibleCells& cells, VI x, VI y, VI z) {
  const VI row = hn::Add(hn::Mul(z, SetI(cells.count().y)), y);
  return hn::Add(hn::Mul(row, SetI(cells.count().x)), x);
}

/// Returns the rays of `alive` whose cell (x, y, z), inside the grid, is visible.
HWY_INLINE MF IsVisibleCell(const VisibleCells& cells, MF alive, VI x, VI y, VI z) {
  const DF df;
  const DI di;
  static_assert(VisibleCells::edge == 4);
  const VI block = BlockAt(cells, hn::ShiftRight<2>(x), hn::ShiftRight<2>(y), hn::ShiftRight<2>(z));
  const VI word = hn::OrAnd(hn::Add(block, block), hn::ShiftRight<1>(z), SetI(1));
  const auto seen = hn::TestBit(hn::GatherIndex(di, cells.words(), word), BitOfCell(x, y, z));
  return hn::And(alive, hn::RebindMask(df, seen));
}

/// Returns the rays of `alive` whose position, clamped to the grid, lies in a visible cell.
HWY_INLINE MF InVisibleCell(const VisibleCells& cells, MF alive, const V3& clamped) {
  return IsVisibleCell(cells, alive, Truncated(clamped.x), Truncated(clamped.y), Truncated(clamped.z));
}

#if HWY_TARGET == HWY_SCALAR || HWY_MAX_BYTES < 32
/// Fallback: registers are too short to hold the words.
template <int kSteps>
struct CellWindows {
  CellWindows(const VisibleCells&, const EmptySpaceSkipper&, int) {}
  static constexpr bool fits(int) { return false; }
  static MF IsVisible(int, MF alive, const V3&) { return alive; }
};
#else
/// The visible cells that a packet meets at `kSteps` consecutive steps. The box around the packet mostly lies
/// in 2 x 2 x 2 blocks, whose words fit into registers. Looking the words up there takes half as long as
/// gathers do.
template <int kSteps>
class CellWindows {
  static constexpr int kLanes = hn::MaxLanes(DI());

 public:
  HWY_INLINE CellWindows(const VisibleCells& cells, const EmptySpaceSkipper& packet, int step)
      : words_(cells.words()), nextRow_(2 * cells.count().x), nextSlice_(nextRow_ * cells.count().y) {
    const DI di;
    for (int n = 0; n < kSteps; n += kLanes) {
      VI block[3], farthest = hn::Zero(di);
      for (int a = 0; a < 3; ++a) {
        const auto voxels = packet.VoxelsFrom(step + n, a);
        block[a] = hn::ShiftRight<2>(voxels.low);
        farthest = hn::Max(farthest, hn::Sub(hn::ShiftRight<2>(voxels.high), block[a]));
      }
      fits_ |= std::uint64_t(BitsOf(hn::RebindMask(DF(), hn::Lt(farthest, SetI(2))))) << n;
      hn::Store(BlockAt(cells, block[0], block[1], block[2]), di, block_ + n);
      const VI oddInSlice =
          hn::OrAnd(hn::And(hn::ShiftLeft<1>(block[0]), SetI(2)), hn::ShiftLeft<2>(block[1]), SetI(4));
      hn::Store(hn::OrAnd(oddInSlice, hn::ShiftLeft<3>(block[2]), SetI(8)), di, odd_ + n);
    }
  }

  /// Returns true if the packet is narrow enough at the n-th of these steps.
  bool fits(int n) const { return fits_ >> n & 1; }

  /// Returns the rays of `alive` whose position at the n-th step, clamped to the grid, lies in a visible
  /// cell.
  HWY_INLINE MF IsVisible(int n, MF alive, const V3& place) const {
    // Truncation towards 0 clamps positions before the first voxel. No position lies a whole voxel behind the
    // last.
    const VI x = Truncated(place.x), y = Truncated(place.y), z = Truncated(place.z);
    VI at = hn::And(hn::ShiftRight<1>(z), SetI(1));
    at = hn::OrAnd(at, hn::ShiftRight<1>(x), SetI(2));
    at = hn::OrAnd(at, y, SetI(4));
    at = hn::Xor(hn::OrAnd(at, hn::ShiftLeft<1>(z), SetI(8)), SetI(odd_[n]));
    const auto seen = hn::TestBit(WordAt(words_ + 2 * std::int64_t(block_[n]), at), BitOfCell(x, y, z));
    return hn::And(alive, hn::RebindMask(DF(), seen));
  }

 private:
  /// Returns word at[lane] of 16. The words belong to 2 x 2 x 2 neighbouring blocks from `first` on: two
  /// along i, then rows along j, then slices along k.
  HWY_INLINE VI WordAt(const std::int32_t* first, VI at) const {
    const hn::Full256<std::int32_t> d8;
    const auto slice = [&](const std::int32_t* words) {
      const hn::Full128<std::int32_t> d4;
      return hn::Combine(d8, hn::LoadU(d4, words + nextRow_), hn::LoadU(d4, words));
    };
    const auto near = slice(first), far = slice(first + nextSlice_);
#if HWY_MAX_BYTES == 64
    return hn::TableLookupLanes(hn::Combine(DI(), far, near), hn::IndicesFromVec(DI(), at));
#else
    const auto inSlice = hn::IndicesFromVec(d8, hn::And(at, SetI(7)));
    return hn::IfThenElse(hn::TestBit(at, SetI(8)), hn::TableLookupLanes(far, inSlice),
                          hn::TableLookupLanes(near, inSlice));
#endif
  }

  const std::int32_t* words_;
  std::int64_t nextRow_, nextSlice_;
  std::uint64_t fits_ = 0;                ///< Bit n: the packet is narrow enough at the n-th step.
  HWY_ALIGN std::int32_t block_[kSteps];  ///< First block of each step.
  HWY_ALIGN std::int32_t odd_[kSteps];    ///< Bits of the axes with odd block indices, as in `at`.
};
#endif

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
