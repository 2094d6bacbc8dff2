#include "viewer/segment/occupancy.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "viewer/segment/gaussian.h"
#include "viewer/volume/buffer.h"

namespace volumen {

namespace {

constexpr float clampTo = 0.02f;  // least distance of voxels from 1/2 on their side
// These keep a line of corner-to-corner steps connected with the least added volume; beside a line at least
// 1/3 is needed. They were found by trying lines in all directions, which 3 G(0.6) breaks.
constexpr double lineSigma = 0.65;
constexpr float lineTimes = 4, mostBesideLine = 0.36f;

// Returns the opening of the mask by a box of 2 voxels along the axes in `two` and 1 along the others.
BitMask openedByBox(const BitMask& mask, glm::bvec3 two, const CancelToken& cancel) {
  const glm::ivec3 size = mask.size(), far(two.x, two.y, two.z);
  const auto filtered = [&](const BitMask& from, bool erode) {
    BitMask to(mask.geometry());
    const std::vector<std::uint64_t> nothing(std::size_t(mask.wordsPerRow()));
    parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t n = begin; n < end && !cancel.cancelled(); ++n) {
        const int j = int(n % size.y), k = int(n / size.y);
        const auto row = to.row(j, k);
        if (erode) std::ranges::fill(row, ~std::uint64_t(0));
        for (int dk = 0; dk <= far.z; ++dk)
          for (int dj = 0; dj <= far.y; ++dj) {
            const int y = erode ? j + dj : j - dj, z = erode ? k + dk : k - dk;
            const bool isBeyond = y < 0 || z < 0 || y >= size.y || z >= size.z;
            const auto other = isBeyond ? std::span<const std::uint64_t>(nothing) : from.row(y, z);
            for (std::size_t w = 0; w < row.size(); ++w) {
              const std::uint64_t next = w + 1 < row.size() ? other[w + 1] : 0,
                                  last = w > 0 ? other[w - 1] : 0;
              if (erode)
                row[w] &= two.x ? other[w] & (other[w] >> 1 | next << 63) : other[w];
              else
                row[w] |= two.x ? other[w] | (other[w] << 1 | last >> 63) : other[w];
            }
          }
      }
    });
    return to;
  };
  return filtered(filtered(mask, true), false);
}

// Voxels thinner than two voxels in at least one direction, and those thinner in at least two.
struct ThinParts {
  BitMask thin, lines;
};

ThinParts thinPartsOf(const BitMask& mask, const CancelToken& cancel) {
  const BitMask thin = subtracted(mask, openedByBox(mask, {true, true, true}, cancel));
  BitMask lines = thin;
  for (int across = 0; across < 3; ++across) {
    glm::bvec3 square(true);
    square[across] = false;
    lines = subtracted(std::move(lines), openedByBox(mask, square, cancel));
  }
  return {thin, lines};
}

// Computes the field of one block. Not thread-safe.
class OccupancyBlock {
 public:
  OccupancyBlock(const BitMask& mask, const ThinParts& parts, const GaussianKernel& kernel,
                 const GaussianKernel& lineKernel)
      : mask_(mask),
        parts_(parts),
        reach_(kernel.reach()),
        lineReach_(lineKernel.reach()),
        leastThin_(1 - kernel.besideMiddle()),
        smooth_(kernel),
        smoothLines_(lineKernel) {}

  void write(const VoxelBox& block, OccupancyField& field) {
    window_.read(mask_, grownBox(block, reach_), BeyondGrid::nothing);
    lines_.read(parts_.lines, grownBox(block, lineReach_), BeyondGrid::nothing);
    if (window_.empty() && lines_.empty()) return;
    own_.read(mask_, block, BeyondGrid::nothing);
    thin_.read(parts_.thin, block, BeyondGrid::nothing);
    const float* values = smooth_.smoothed(window_);
    const float* lines = lines_.empty() ? nullptr : smoothLines_.smoothed(lines_);
    const glm::i64vec3 size = field.size();
    const int width = std::min(blockWidth, field.box.high.x - block.low.x + 1);
    for (int k = block.low.z; k <= block.high.z; ++k)
      for (int j = block.low.y; j <= block.high.y; ++j, values += blockWidth) {
        const glm::i64vec3 at = glm::ivec3(block.low.x, j, k) - field.box.low;
        const std::uint64_t in = own_.row(j - block.low.y, k - block.low.z)[0];
        const std::uint64_t thin = thin_.row(j - block.low.y, k - block.low.z)[0];
        float* const to = field.values.data() + (at.z * size.y + at.y) * size.x + at.x;
        for (int i = 0; i < width; ++i)
          to[i] = valueOf(values[i], lines ? lineTimes * lines[i] : 0, in >> i & 1, thin >> i & 1);
        if (lines) lines += blockWidth;
      }
  }

 private:
  float valueOf(float smoothed, float ofLines, bool isIn, bool isThin) const {
    if (!isIn) return std::min(std::max(smoothed, std::min(ofLines, mostBesideLine)), 0.5f - clampTo);
    const float kept = std::max(smoothed, std::min(ofLines, 1.0f));
    return std::max(kept, isThin ? leastThin_ : 0.5f + clampTo);
  }

  const BitMask& mask_;
  const ThinParts& parts_;
  const glm::ivec3 reach_, lineReach_;
  const float leastThin_;  // keeps a one-voxel plate one voxel thick
  GaussianBlock smooth_, smoothLines_;
  BitWindow window_, lines_, own_, thin_;
};

// Returns the box of the field for a mask within `voxels`.
VoxelBox fieldBox(const VoxelBox& voxels, const GaussianKernel& kernel, const GaussianKernel& lineKernel) {
  return grownBox(voxels, glm::max(kernel.reach(), lineKernel.reach()) + 1);
}

}  // namespace

std::size_t occupancyBytes(const BitMask& mask, double sigma) {
  const std::optional<VoxelBox> voxels = mask.box();
  if (!voxels) return 0;
  const VoxelBox box =
      fieldBox(*voxels, GaussianKernel::inVoxels(sigma), GaussianKernel::inVoxels(lineSigma));
  const glm::i64vec3 size = box.high - box.low + 1;
  return std::size_t(size.x * size.y * size.z) * sizeof(float);
}

OccupancyField occupancyOf(const BitMask& mask, double sigma, const CancelToken& cancel) {
  OccupancyField field{mask.geometry(), {glm::ivec3(0), glm::ivec3(-1)}, {}};
  const std::optional<VoxelBox> box = mask.box();
  if (!box) return field;
  const auto kernel = GaussianKernel::inVoxels(sigma), lineKernel = GaussianKernel::inVoxels(lineSigma);
  const BitMask none(mask.geometry());
  const ThinParts parts = sigma > 0 ? thinPartsOf(mask, cancel) : ThinParts{none, none};
  if (cancel.cancelled()) return field;
  field.box = fieldBox(*box, kernel, lineKernel);
  const glm::i64vec3 size = field.size();
  field.values = zeros<float>(std::size_t(size.x * size.y * size.z));
  forEachBlock(field.box, 16, cancel, [&] {
    return [&, work = OccupancyBlock(mask, parts, kernel, lineKernel)](const VoxelBox& block) mutable {
      work.write(block, field);
    };
  });
  return field;
}

}  // namespace volumen
