#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "viewer/segment/bit_window.h"
#include "viewer/segment/gaussian.h"
#include "viewer/segment/smoothing.h"

namespace volumen {

namespace {

// The voxels (first, y, z) .. (last, y, z) of a ball.
struct BallRow {
  int y, z, first, last;
};

struct MedianBall {
  std::vector<BallRow> rows;
  glm::ivec3 reach{0};
};

MedianBall medianBall(const VoxelGeometry& geometry, double radiusMm) {
  MedianBall ball;
  const double radius = radiusMm * (1 + 1e-9);  // tolerates rounding of distances equal to the radius
  const glm::dmat3 back = glm::transpose(geometry.voxelFromPatientStep());
  for (int a = 0; a < 3; ++a)
    ball.reach[a] = std::min(int(radius * glm::length(back[a])), geometry.size[a] - 1);
  const glm::ivec3 r = ball.reach;
  const auto isIn = [&](int x, int y, int z) {
    return glm::length(geometry.patientFromVoxelStep * glm::dvec3(x, y, z)) <= radius;
  };
  for (int z = -r.z; z <= r.z; ++z)
    for (int y = -r.y; y <= r.y; ++y) {
      int first = -r.x, last = r.x;
      while (first <= last && !isIn(first, y, z)) ++first;
      while (last > first && !isIn(last, y, z)) --last;
      if (first <= last) ball.rows.push_back({y, z, first, last});
    }
  return ball;
}

// Median filter of one block: sets voxels with more mask voxels than others around them. Not thread-safe.
class MedianBlock {
 public:
  MedianBlock(const BitMask& mask, const MedianBall& ball) : mask_(mask), ball_(ball) {}

  void write(const VoxelBox& block, BitMask& to) {
    const VoxelBox box = grownBox(block, ball_.reach);
    window_.read(mask_, box, BeyondGrid::asAtBorder);
    if (window_.empty() || window_.full()) return;
    sumRows(box);
    const glm::ivec3 size = window_.size(), reach = ball_.reach;
    const int width = std::min(blockWidth, mask_.size().x - block.low.x);
    for (int k = block.low.z; k <= block.high.z; ++k)
      for (int j = block.low.y; j <= block.high.y; ++j) {
        int more[blockWidth] = {};
        for (const BallRow& row : ball_.rows) {
          const int* const sums = sumsOf(j - box.low.y + row.y, k - box.low.z + row.z, size) + reach.x;
          const int *const upper = sums + row.last + 1, *const lower = sums + row.first;
          for (int i = 0; i < blockWidth; ++i) more[i] += upper[i] - lower[i];
        }
        std::uint64_t& word = to.row(j, k)[std::size_t(block.low.x / blockWidth)];
        const std::uint64_t before = word;
        word = 0;
        for (int i = 0; i < width; ++i)
          word |= (more[i] == 0 ? before >> i & 1 : std::uint64_t(more[i] > 0)) << i;
      }
  }

 private:
  int* sumsOf(int j, int k, glm::ivec3 size) {
    return sums_.data() + (std::ptrdiff_t(k) * size.y + j) * (size.x + 1);
  }

  // Computes prefix sums of each row of the box: mask voxels minus others before each voxel. Voxels beyond
  // the grid count as 0.
  void sumRows(const VoxelBox& box) {
    const glm::ivec3 size = window_.size(), grid = mask_.size();
    sums_.resize(std::size_t(size.x + 1) * std::size_t(size.y) * std::size_t(size.z));
    const int begin = std::max(0, -box.low.x), end = std::clamp(grid.x - box.low.x, begin, size.x);
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j) {
        int* const sums = sumsOf(j, k, size);
        std::fill_n(sums, size.x + 1, 0);
        const int y = box.low.y + j, z = box.low.z + k;
        if (y < 0 || z < 0 || y >= grid.y || z >= grid.z) continue;
        const auto bits = window_.row(j, k);
        int sum = 0;
        for (int i = begin; i < end; ++i) {
          sums[i] = sum;
          sum += (bits[std::size_t(i) / 64] >> i % 64 & 1) ? 1 : -1;
        }
        std::fill(sums + end, sums + size.x + 1, sum);
      }
  }

  const BitMask& mask_;
  const MedianBall& ball_;
  BitWindow window_;
  std::vector<int> sums_;
};

}  // namespace

BitMask medianSmoothed(const BitMask& mask, double radiusMm, const CancelToken& cancel) {
  const MedianBall ball = medianBall(mask.geometry(), radiusMm);
  BitMask smoothed = mask;
  forEachBlock({glm::ivec3(0), mask.size() - 1}, blockEdgeFor(ball.reach), cancel, [&] {
    return [&, median = MedianBlock(mask, ball)](const VoxelBox& block) mutable {
      median.write(block, smoothed);
    };
  });
  return smoothed;
}

}  // namespace volumen
