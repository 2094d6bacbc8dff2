#include "viewer/acceleration/segment_cells.h"

#include <algorithm>
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
  // Of the rows of voxels in turn: 1 inside; then of pairs, fours and eights of voxels: how many are.
  std::vector<std::uint8_t> inside(width * std::size_t(rows * slices));
  for (int z = 0; z < slices; ++z)
    for (int y = 0; y < rows; ++y) {
      const float* from = field_->values.data() + at({0, j * edge + y, k * edge + z}, size);
      std::uint8_t* to = inside.data() + width * std::size_t(z * rows + y);
      for (std::size_t i = 0; i < width; ++i) to[i] = from[i] >= level;
    }
  for (int z = 0; z + 1 < slices; ++z)
    for (int y = 0; y + 1 < rows; ++y) {
      const std::uint8_t* a = inside.data() + width * std::size_t(z * rows + y);
      const std::uint8_t *b = a + width, *c = a + width * std::size_t(rows), *d = c + width;
      for (std::size_t i = 0; i + 1 < width; ++i) {
        const int count = a[i] + a[i + 1] + b[i] + b[i + 1] + c[i] + c[i + 1] + d[i] + d[i + 1];
        if (count != 0 && count != 8)
          blocks_[at({int(i) / edge, j, k}, blockCount_)] |= bitOf({int(i), y, z});
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

// One pass each way over the neighbours that it has come by: exact for this distance.
void SegmentCells::findDistances() {
  constexpr int most = 255;
  distances_.resize(blocks_.size());
  for (std::size_t n = 0; n < blocks_.size(); ++n) distances_[n] = blocks_[n] ? 0 : most;
  const auto pass = [&](int by) {
    const auto begin = [by](int count) { return by > 0 ? 0 : count - 1; };
    const auto isIn = [](int n, int count) { return n >= 0 && n < count; };
    for (int k = begin(blockCount_.z); isIn(k, blockCount_.z); k += by)
      for (int j = begin(blockCount_.y); isIn(j, blockCount_.y); j += by)
        for (int i = begin(blockCount_.x); isIn(i, blockCount_.x); i += by) {
          int least = distances_[at({i, j, k}, blockCount_)];
          for (int n = 0; n < 13; ++n) {
            const glm::ivec3 other = glm::ivec3(i, j, k) + by * (glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1);
            if (isIn(other.x, blockCount_.x) && isIn(other.y, blockCount_.y) && isIn(other.z, blockCount_.z))
              least = std::min(least, distances_[at(other, blockCount_)] + 1);
          }
          distances_[at({i, j, k}, blockCount_)] = std::uint8_t(least);
        }
  };
  pass(1);
  pass(-1);
}

}  // namespace volumen
