#include "viewer/segment/smoothing.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/common.hpp>

#include "viewer/segment/gaussian.h"

namespace volumen {

namespace {

// Smaller differences are rounding and count as equal.
constexpr float sameOccupancy = 1e-6f;

bool isLocked(std::span<const std::uint8_t> locked, std::uint8_t label) {
  return std::ranges::find(locked, label) != locked.end();
}

// Returns the labels of a box; labels at the grid border continue beyond it.
std::vector<std::uint8_t> labelsIn(const DenseLabels& map, const VoxelBox& box) {
  const glm::ivec3 grid = map.geometry.size;
  std::vector<std::uint8_t> labels;
  labels.reserve(std::size_t(box.high.x - box.low.x + 1) * std::size_t(box.high.y - box.low.y + 1) *
                 std::size_t(box.high.z - box.low.z + 1));
  const int first = std::clamp(box.low.x, 0, grid.x - 1), last = std::clamp(box.high.x, 0, grid.x - 1);
  for (int k = box.low.z; k <= box.high.z; ++k)
    for (int j = box.low.y; j <= box.high.y; ++j) {
      const glm::i64vec2 in(std::clamp(j, 0, grid.y - 1), std::clamp(k, 0, grid.z - 1));
      const std::uint8_t* const row = map.labels.data() + (in.y * grid.y + in.x) * grid.x;
      labels.insert(labels.end(), std::size_t(first - box.low.x), row[first]);
      labels.insert(labels.end(), row + first, row + last + 1);
      labels.insert(labels.end(), std::size_t(box.high.x - last), row[last]);
    }
  return labels;
}

// Chooses the label of each voxel of a block. Not thread-safe.
class JointBlock {
 public:
  JointBlock(const DenseLabels& map, const GaussianKernel& kernel, std::span<const std::uint8_t> locked)
      : map_(map), reach_(kernel.reach()), smooth_(kernel) {
    for (int label = 0; label < 256; ++label) locked_[label] = isLocked(locked, std::uint8_t(label));
  }

  void write(const VoxelBox& block, std::vector<std::uint8_t>& to) {
    const VoxelBox box = grownBox(block, reach_);
    const std::vector<std::uint8_t> labels = labelsIn(map_, box);
    std::array<bool, 256> there{};
    for (std::uint8_t label : labels) there[label] = true;
    if (std::ranges::count(there, true) == 1) return;
    const glm::ivec3 size = block.high - block.low + 1;
    const std::size_t count = std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
    best_.assign(count, -1);
    const std::vector<std::uint8_t> own = labelsIn(map_, block);
    chosen_ = own;
    for (int label = 0; label < 256; ++label)
      if (there[label] && !locked_[label]) consider(std::uint8_t(label), labels, box, own);
    const glm::ivec3 grid = map_.geometry.size;
    const int width = std::min(blockWidth, grid.x - block.low.x);
    const std::uint8_t* from = chosen_.data();
    for (int k = block.low.z; k <= block.high.z; ++k)
      for (int j = block.low.y; j <= block.high.y; ++j, from += blockWidth)
        std::copy_n(from, width, to.begin() + (std::int64_t(k) * grid.y + j) * grid.x + block.low.x);
  }

 private:
  void consider(std::uint8_t label, const std::vector<std::uint8_t>& labels, const VoxelBox& box,
                const std::vector<std::uint8_t>& own) {
    window_.read(labels, label, box);
    const float* const values = smooth_.smoothed(window_);
    for (std::size_t n = 0; n < own.size(); ++n) {
      const bool isMore = values[n] > best_[n] + sameOccupancy;
      const bool staysOwn = own[n] == label && values[n] >= best_[n] - sameOccupancy;
      if (locked_[own[n]] || !(isMore || staysOwn)) continue;
      best_[n] = std::max(best_[n], values[n]);
      chosen_[n] = label;
    }
  }

  const DenseLabels& map_;
  const glm::ivec3 reach_;
  GaussianBlock smooth_;
  BitWindow window_;
  std::array<bool, 256> locked_{};
  std::vector<float> best_;
  std::vector<std::uint8_t> chosen_;
};

// Returns `map` with new labels; unchanged bricks are shared.
LabelMap withLabels(const LabelMap& map, const DenseLabels& before, const std::vector<std::uint8_t>& labels) {
  LabelEdit edit(map);
  const glm::ivec3 size = map.geometry().size;
  const auto rowLength = std::size_t(size.x);
  std::size_t at = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j, at += rowLength) {
      if (std::memcmp(&before.labels[at], &labels[at], rowLength) == 0) continue;
      for (int i = 0; i < size.x; ++i) edit.set({i, j, k}, labels[at + std::size_t(i)]);
    }
  return edit.done();
}

}  // namespace

BitMask gaussianSmoothed(const BitMask& mask, double sigmaMm, const CancelToken& cancel) {
  const std::optional<VoxelBox> box = mask.box();
  if (!box || !(sigmaMm > 0)) return mask;
  const GaussianKernel kernel = GaussianKernel::inPatient(mask.geometry(), sigmaMm);
  VoxelBox within = grownBox(*box, kernel.reach());
  within.low = glm::max(within.low, glm::ivec3(0));
  within.low.x &= ~(blockWidth - 1);
  within.high = glm::min(within.high, mask.size() - 1);
  BitMask smoothed(mask.geometry());
  forEachBlock(within, blockEdgeFor(kernel.reach()), cancel, [&] {
    return [&, window = BitWindow(), smooth = GaussianBlock(kernel)](const VoxelBox& block) mutable {
      window.read(mask, grownBox(block, kernel.reach()), BeyondGrid::asAtBorder);
      if (window.empty()) return;
      const float* values = smooth.smoothed(window);
      const int width = std::min(blockWidth, mask.size().x - block.low.x);
      for (int k = block.low.z; k <= block.high.z; ++k)
        for (int j = block.low.y; j <= block.high.y; ++j, values += blockWidth) {
          std::uint64_t word = 0;
          for (int i = 0; i < width; ++i) word |= std::uint64_t(values[i] >= 0.5f - sameOccupancy) << i;
          smoothed.row(j, k)[std::size_t(block.low.x / blockWidth)] = word;
        }
    };
  });
  return smoothed;
}

LabelMap jointSmoothed(const LabelMap& map, double sigmaMm, std::span<const std::uint8_t> locked,
                       const CancelToken& cancel) {
  if (!(sigmaMm > 0)) return map;
  const GaussianKernel kernel = GaussianKernel::inPatient(map.geometry(), sigmaMm);
  const DenseLabels before = map.dense();
  std::vector<std::uint8_t> labels = before.labels;
  const VoxelBox grid{glm::ivec3(0), map.geometry().size - 1};
  forEachBlock(grid, blockEdgeFor(kernel.reach()), cancel, [&] {
    return [&, joint = JointBlock(before, kernel, locked)](const VoxelBox& block) mutable {
      joint.write(block, labels);
    };
  });
  return withLabels(map, before, labels);
}

}  // namespace volumen
