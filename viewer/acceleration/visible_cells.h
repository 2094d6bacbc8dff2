#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/tables/curve_table.h"

namespace volumen {

/// Densities as integers, i fastest: of 16 bits, where `flip` is 0x8000 if they are stored unsigned, offset
/// by that; or of 8, one in so many bytes; or none.
struct StoredDensities {
  const std::int16_t* in16 = nullptr;
  std::uint16_t flip = 0;
  const std::uint8_t* in8 = nullptr;
  int stride8 = 1;
  int rowVoxels = 0;  ///< from the start of a row along i to that of the next

  explicit operator bool() const { return in16 || in8; }
  bool operator==(const StoredDensities&) const = default;
};

/// Which cells of a grid can show anything (the cell (i, j, k) lies between the voxels (i, j, k) and
/// (i, j, k) + 1): what rays ask before they take a sample. Blocks of 4 x 4 x 4 cells are looked into where
/// rays first come by, so that no edit of the curve waits for a pass over the volume.
class VisibleCells {
 public:
  static constexpr int edge = 4;

  /// Begins anew. `visible`: one entry a block, i fastest, not 0 where it holds a visible value. Without
  /// densities all cells of visible blocks count.
  void begin(glm::ivec3 size, const StoredDensities& densities, const CurveTable& curve,
             const std::vector<std::uint8_t>& visible);

  /// Looks into the blocks that hold the positions from `low` to `high` (voxels, inside the grid) and were
  /// not looked into before. Threads may do so at once.
  void lookInto(glm::vec3 low, glm::vec3 high) const;

  /// Asks for the words of the blocks that hold such positions ahead of time.
  void prefetch(glm::vec3 low, glm::vec3 high) const;

  /// Two words a block: cell (i, j, k) of block b is bit i % 4 + 4 (j % 4) + 16 (k % 2) of word
  /// 2 b + k % 4 / 2. Only of blocks that were looked into. Words of a slice, a row and a block more can be
  /// read behind the last.
  const std::int32_t* words() const { return reinterpret_cast<const std::int32_t*>(words_.data()); }
  glm::ivec3 count() const { return count_; }
  std::size_t bytes() const { return (words_.size() + states_.size()) * sizeof(words_[0]); }

 private:
  /// Cells whose densities reach up to `low` and down to `high` can show something.
  struct Span {
    std::int16_t low, high;
  };
  static std::vector<Span> spansOf(const CurveTable& curve);
  /// Eight voxels along i, of which a block asks for five; clamped to the grid.
  using Row = std::array<std::int16_t, 8>;
  struct RowRange;
  static void takeIn(const RowRange& from, RowRange& to);
  Row rowOf(glm::ivec3 voxel) const;
  std::uint64_t cellsOf(glm::ivec3 block) const;
  /// Unless another thread does so or has done; `states`: the word that has the block's.
  void lookInto(glm::ivec3 block, std::uint64_t& states) const;
  /// Which row of blocks along i it is of.
  std::size_t rowAt(glm::ivec3 block) const { return std::size_t(block.z) * count_.y + block.y; }

  glm::ivec3 size_{0}, count_{0};
  StoredDensities densities_;
  std::vector<Span> spans_;
  mutable std::vector<std::uint64_t> words_;
  int stateWords_ = 0;                         ///< of a row along i
  mutable std::vector<std::uint64_t> states_;  ///< two bits a block: whether it was looked into
};

}  // namespace volumen
