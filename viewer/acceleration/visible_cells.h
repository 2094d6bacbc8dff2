#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/tables/curve_table.h"

namespace volumen {

/// Densities as integers, i fastest: `in16` with 16 bits, `in8` with 8 bits, one in every `stride8` bytes, or
/// none. `flip` is 0x8000 if 16 bits are stored unsigned, and so offset by 32768.
struct StoredDensities {
  const std::int16_t* in16 = nullptr;
  std::uint16_t flip = 0;
  const std::uint8_t* in8 = nullptr;
  int stride8 = 1;
  int rowVoxels = 0;  ///< Distance of the starts of adjacent rows along i, in voxels.

  explicit operator bool() const { return in16 || in8; }
  bool operator==(const StoredDensities&) const = default;
};

/// Tells which cells of a grid can be visible, before rays take a sample. Cell (i, j, k) lies between the
/// voxels (i, j, k) and (i, j, k) + 1. Blocks of 4 x 4 x 4 cells are examined when rays first reach them, so
/// no edit of the curve waits for a full pass.
class VisibleCells {
 public:
  static constexpr int edge = 4;

  /// Starts over. `visible`: one entry per block, i fastest, not 0 if it holds a visible value. Without
  /// densities all cells of visible blocks count as visible.
  void begin(glm::ivec3 size, const StoredDensities& densities, const CurveTable& curve,
             const std::vector<std::uint8_t>& visible);

  /// Examines the blocks that hold the positions from `low` to `high` (voxels, inside the grid), unless done
  /// before. Thread-safe.
  void lookInto(glm::vec3 low, glm::vec3 high) const;

  /// Prefetches the words of the blocks that hold such positions.
  void prefetch(glm::vec3 low, glm::vec3 high) const;

  /// Returns two words per block, valid for examined blocks. Cell (i, j, k) of block b is bit i % 4 + 4 (j %
  /// 4) + 16 (k % 2) of word 2 b + k % 4 / 2. Words of a slice, a row and a block more are readable behind
  /// the last.
  const std::int32_t* words() const { return reinterpret_cast<const std::int32_t*>(words_.data()); }
  glm::ivec3 count() const { return count_; }
  std::size_t bytes() const { return (words_.size() + states_.size()) * sizeof(words_[0]); }

 private:
  /// Cells whose range of densities overlaps `low` to `high` can be visible.
  struct Span {
    std::int16_t low, high;
  };
  static std::vector<Span> spansOf(const CurveTable& curve);
  /// Eight voxels along i, of which a block needs five; clamped to the grid.
  using Row = std::array<std::int16_t, 8>;
  struct RowRange;
  static void takeIn(const RowRange& from, RowRange& to);
  Row rowOf(glm::ivec3 voxel) const;
  std::uint64_t cellsOf(glm::ivec3 block) const;
  /// Examines a block unless that is done. Waits if another thread is examining it. `states` is the word that
  /// holds the block's state.
  void lookInto(glm::ivec3 block, std::uint64_t& states) const;
  /// Returns the index of the block's row along i.
  std::size_t rowAt(glm::ivec3 block) const { return std::size_t(block.z) * count_.y + block.y; }

  glm::ivec3 size_{0}, count_{0};
  StoredDensities densities_;
  std::vector<Span> spans_;
  mutable std::vector<std::uint64_t> words_;
  int stateWords_ = 0;                         ///< Number of words in a row along i.
  mutable std::vector<std::uint64_t> states_;  ///< Two bits per block: not examined yet, and being examined.
};

}  // namespace volumen
