#include "viewer/acceleration/segment_cells.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/common.hpp>
#include <limits>

#include "viewer/volume/parallel.h"

namespace volumen {

SegmentCells::SegmentCells(std::shared_ptr<const OccupancyField> field) : field_(std::move(field)) {
  if (field_->values.empty()) return;
  blockCount_ = (field_->size() - 1 + (edge - 1)) / edge;
  findCells();
  findBox();
  findDistances();
}

void SegmentCells::findCells() {
  blocks_.resize(std::size_t(blockCount_.x) * std::size_t(blockCount_.y) * std::size_t(blockCount_.z));
  parallelFor(std::int64_t(blockCount_.y) * blockCount_.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n)
      findRowOfBlocks(int(n % blockCount_.y), int(n / blockCount_.y));
  });
}

void SegmentCells::findRowOfBlocks(int j, int k) {
  const glm::ivec3 size = field_->size();
  const auto width = std::size_t(size.x);
  const int rows = std::min(edge + 1, size.y - j * edge), slices = std::min(edge + 1, size.z - k * edge);
  std::vector<std::uint8_t> inside(width * std::size_t(rows * slices));  // 1 or 0, row by row.
  for (int z = 0; z < slices; ++z)
    for (int y = 0; y < rows; ++y) {
      const float* from = field_->values.data() + at({0, j * edge + y, k * edge + z}, size);
      std::uint8_t* to = inside.data() + width * std::size_t(z * rows + y);
      for (std::size_t i = 0; i < width; ++i) to[i] = from[i] >= level;
    }
  // `any`, `all`: whether any or all of four voxels adjacent in j and k are inside. `crossed`: whether the
  // surface passes through a cell.
  std::vector<std::uint8_t> any(width), all(width), crossed(width + 8);
  for (int z = 0; z + 1 < slices; ++z)
    for (int y = 0; y + 1 < rows; ++y) {
      const std::uint8_t* a = inside.data() + width * std::size_t(z * rows + y);
      const std::uint8_t *b = a + width, *c = a + width * std::size_t(rows), *d = c + width;
      for (std::size_t i = 0; i < width; ++i) any[i] = a[i] | b[i] | c[i] | d[i];
      for (std::size_t i = 0; i < width; ++i) all[i] = a[i] & b[i] & c[i] & d[i];
      for (std::size_t i = 0; i + 1 < width; ++i)
        crossed[i] = (any[i] | any[i + 1]) & ((all[i] & all[i + 1]) ^ 1);
      for (std::size_t eight = 0; eight < width; eight += 8) {
        std::uint64_t cells;
        std::memcpy(&cells, crossed.data() + eight, sizeof cells);
        for (; cells; cells &= cells - 1) {
          const int i = int(eight) + std::countr_zero(cells) / 8;
          blocks_[at({i / edge, j, k}, blockCount_)] |= bitOf({i, y, z});
        }
      }
    }
}

void SegmentCells::findBox() {
  VoxelBox found{glm::ivec3(std::numeric_limits<int>::max()), glm::ivec3(-1)};
  for (int k = 0; k < blockCount_.z; ++k)
    for (int j = 0; j < blockCount_.y; ++j)
      for (int i = 0; i < blockCount_.x; ++i) {
        const glm::ivec3 n(i, j, k);
        if (!block(n)) continue;
        found.low = glm::min(found.low, n), found.high = glm::max(found.high, n);
      }
  if (found.high.x >= 0)
    box_ = {found.low * edge, glm::min(found.high * edge + edge, field_->size() - 1) - 1};
}

// One pass in each direction over the neighbours already visited, row by row. This is exact for this
// distance.
void SegmentCells::findDistances() {
  constexpr std::uint8_t most = 254;  // One more still fits into a byte.
  const glm::ivec3 count = blockCount_;
  const auto width = std::size_t(count.x);
  distances_.resize(blocks_.size());
  for (std::size_t n = 0; n < blocks_.size(); ++n) distances_[n] = blocks_[n] ? 0 : most;
  std::vector<std::uint8_t> least(width + 2);  // Over the rows visited, with one extra entry at each end.
  const auto takeRow = [&](int j, int k) {
    if (j < 0 || k < 0 || j >= count.y || k >= count.z) return;
    const std::uint8_t* row = distances_.data() + at({0, j, k}, count);
    for (std::size_t i = 0; i < width; ++i) least[i + 1] = std::min(least[i + 1], row[i]);
  };
  const auto pass = [&](int by) {
    for (int n = 0; n < count.y * count.z; ++n) {
      const int m = by > 0 ? n : count.y * count.z - 1 - n, j = m % count.y, k = m / count.y;
      std::ranges::fill(least, most);
      takeRow(j - by, k);
      for (int dj = -1; dj <= 1; ++dj) takeRow(j + dj, k - by);
      std::uint8_t* row = distances_.data() + at({0, j, k}, count);
      for (std::size_t i = 0; i < width; ++i)
        row[i] = std::min(row[i], std::uint8_t(std::min({least[i], least[i + 1], least[i + 2]}) + 1));
      if (by > 0)
        for (std::size_t i = 1; i < width; ++i) row[i] = std::min(row[i], std::uint8_t(row[i - 1] + 1));
      else
        for (std::size_t i = width - 1; i-- > 0;) row[i] = std::min(row[i], std::uint8_t(row[i + 1] + 1));
    }
  };
  pass(1);
  pass(-1);
}

}  // namespace volumen
