#include "viewer/segment/label_map.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <glm/common.hpp>

#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr int brickEdge = LabelMap::edge;

std::size_t placeIn(glm::ivec3 inBrick) {
  return std::size_t(inBrick.x + brickEdge * (inBrick.y + brickEdge * inBrick.z));
}

glm::ivec3 cornerOf(std::size_t brick, glm::ivec3 bricks) {
  const int n = int(brick);
  return brickEdge * glm::ivec3(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y);
}

}  // namespace

LabelMap::Brick LabelMap::Brick::of(std::shared_ptr<const Voxels> voxels, glm::ivec3 size) {
  const std::uint8_t first = (*voxels)[0];
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const auto row = voxels->begin() + std::ptrdiff_t(placeIn({0, j, k}));
      if (std::any_of(row, row + size.x, [&](std::uint8_t label) { return label != first; }))
        return {0, std::move(voxels)};
    }
  return {first, nullptr};
}

bool LabelMap::Brick::operator==(const Brick& other) const {
  if (voxels && other.voxels) return voxels == other.voxels || *voxels == *other.voxels;
  return !voxels && !other.voxels && label == other.label;
}

LabelMap::LabelMap(const VoxelGeometry& geometry)
    : geometry_(geometry),
      bricks_((geometry.size + brickEdge - 1) / brickEdge),
      held_(std::size_t(bricks_.x) * bricks_.y * bricks_.z) {}

LabelMap::LabelMap(const DenseLabels& dense) : LabelMap(dense.geometry) {
  const glm::ivec3 grid = geometry_.size;
  parallelFor(std::int64_t(held_.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const glm::ivec3 corner = cornerOf(std::size_t(n), bricks_), size = sizeOf(std::size_t(n));
      auto voxels = std::make_shared<Voxels>();
      for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j) {
          const std::size_t row = std::size_t(corner.z + k) * grid.y + corner.y + j;
          std::memcpy(voxels->data() + placeIn({0, j, k}), dense.labels.data() + row * grid.x + corner.x,
                      std::size_t(size.x));
        }
      held_[std::size_t(n)] = Brick::of(std::move(voxels), size);
    }
  });
}

std::size_t LabelMap::brickOf(glm::ivec3 voxel) const {
  const glm::ivec3 b = voxel / brickEdge;
  return std::size_t(b.x) + std::size_t(bricks_.x) * (std::size_t(b.y) + std::size_t(bricks_.y) * b.z);
}

glm::ivec3 LabelMap::sizeOf(std::size_t brick) const {
  return glm::min(glm::ivec3(brickEdge), geometry_.size - cornerOf(brick, bricks_));
}

std::uint8_t LabelMap::at(glm::ivec3 voxel) const {
  const Brick& brick = held_[brickOf(voxel)];
  return brick.voxels ? (*brick.voxels)[placeIn(voxel % brickEdge)] : brick.label;
}

void LabelMap::readRow(int j, int k, std::uint8_t* labels) const {
  for (int i = 0; i < geometry_.size.x; i += brickEdge) {
    const Brick& brick = held_[brickOf({i, j, k})];
    const auto count = std::size_t(std::min(brickEdge, geometry_.size.x - i));
    if (brick.voxels)
      std::memcpy(labels + i, brick.voxels->data() + placeIn({0, j % brickEdge, k % brickEdge}), count);
    else
      std::memset(labels + i, brick.label, count);
  }
}

DenseLabels LabelMap::dense() const {
  const glm::ivec3 size = geometry_.size;
  DenseLabels all{geometry_, zeros<std::uint8_t>(std::size_t(geometry_.voxelCount()))};
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row)
      readRow(int(row % size.y), int(row / size.y), all.labels.data() + row * size.x);
  });
  return all;
}

std::size_t LabelMap::bytes() const {
  return sizeof(Voxels) *
         std::size_t(std::ranges::count_if(held_, [](const Brick& b) { return !!b.voxels; }));
}

bool LabelMap::operator==(const LabelMap& other) const {
  return geometry_ == other.geometry_ && held_ == other.held_;
}

std::uint8_t LabelEdit::at(glm::ivec3 voxel) const {
  const auto& written = written_[map_.brickOf(voxel)];
  return written ? (*written)[placeIn(voxel % brickEdge)] : map_.at(voxel);
}

void LabelEdit::set(glm::ivec3 voxel, std::uint8_t label) {
  if (at(voxel) == label) return;
  const std::size_t n = map_.brickOf(voxel);
  auto& written = written_[n];
  if (!written) {
    const LabelMap::Brick& before = map_.held_[n];
    written = std::make_unique<LabelMap::Voxels>();
    if (before.voxels)
      *written = *before.voxels;
    else if (before.label) {
      const glm::ivec3 size = map_.sizeOf(n);
      for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
          std::memset(written->data() + placeIn({0, j, k}), before.label, std::size_t(size.x));
    }
  }
  (*written)[placeIn(voxel % brickEdge)] = label;
}

LabelMap LabelEdit::done() const {
  LabelMap made = map_;
  for (std::size_t n = 0; n < written_.size(); ++n) {
    if (!written_[n]) continue;
    auto brick = LabelMap::Brick::of(std::make_shared<const LabelMap::Voxels>(*written_[n]), map_.sizeOf(n));
    // Bricks that were set back to their old labels stay shared.
    if (brick != map_.held_[n]) made.held_[n] = std::move(brick);
  }
  return made;
}

bool holdSame(const LabelMap& a, const LabelMap& b, std::uint8_t label) {
  if (a.geometry() != b.geometry()) return false;
  const glm::ivec3 grid = a.geometry().size, bricks = a.bricks();
  const auto labelIn = [](const LabelMap::Brick& brick, std::size_t place) {
    return brick.voxels ? (*brick.voxels)[place] : brick.label;
  };
  for (int n = 0; n < bricks.x * bricks.y * bricks.z; ++n) {
    const LabelMap::Brick &one = a.brick(std::size_t(n)), &other = b.brick(std::size_t(n));
    if (one.voxels == other.voxels && one.label == other.label) continue;
    const glm::ivec3 size = glm::min(glm::ivec3(brickEdge), grid - cornerOf(std::size_t(n), bricks));
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const std::size_t place = placeIn({i, j, k});
          if ((labelIn(one, place) == label) != (labelIn(other, place) == label)) return false;
        }
  }
  return true;
}

std::array<std::int64_t, 256> labelCounts(const LabelMap& map) {
  std::array<std::int64_t, 256> counts{};
  const glm::ivec3 grid = map.geometry().size, bricks = map.bricks();
  for (int n = 0; n < bricks.x * bricks.y * bricks.z; ++n) {
    const glm::ivec3 at(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y),
        size = glm::min(glm::ivec3(LabelMap::edge), grid - at * LabelMap::edge);
    const LabelMap::Brick& brick = map.brick(std::size_t(n));
    if (!brick.voxels) {
      counts[brick.label] += std::int64_t(size.x) * size.y * size.z;
      continue;
    }
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j) {
        const auto row = brick.voxels->begin() + (k * LabelMap::edge + j) * LabelMap::edge;
        std::for_each(row, row + size.x, [&](std::uint8_t label) { ++counts[label]; });
      }
  }
  return counts;
}

}  // namespace volumen
