#include "viewer/volume/gradient_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/volume/extremes.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr std::size_t entries = 256;

// Largest differences between neighbours along x, y and z in one line of blocks (b, c), upper faces included,
// by i. Entry i of x lies between i and i + 1.
template <class T>
class LineSlopes {
 public:
  LineSlopes(const std::vector<T>& stored, glm::ivec3 size, int edge)
      : stored_(stored), size_(size), edge_(edge) {
    for (auto& d : largest_) d.resize(std::size_t(size.x) + edge);
  }

  void read(int b, int c) {
    const auto takeIn = rowPasses<T>().takeInDistance;
    for (auto& d : largest_) std::fill(d.begin(), d.end(), Distance<T>(0));
    const int lastRow = std::min(b * edge_ + edge_, size_.y - 1),
              lastSlice = std::min(c * edge_ + edge_, size_.z - 1);
    for (int k = c * edge_; k <= lastSlice; ++k)
      for (int j = b * edge_; j <= lastRow; ++j) {
        const T* row = stored_.data() + (std::size_t(k) * size_.y + j) * std::size_t(size_.x);
        const std::size_t count = size_.x, slice = count * size_.y;
        takeIn(row, row + 1, count - 1, largest_[0].data());
        if (j < lastRow) takeIn(row, row + count, count, largest_[1].data());
        if (k < lastSlice) takeIn(row, row + slice, count, largest_[2].data());
      }
  }

  // Returns the bound for block a of the line, in stored units per voxel.
  double slope(int a) const {
    const auto most = [&](int axis, int count) {
      const auto first = largest_[axis].begin() + a * edge_;
      return double(*std::max_element(first, first + count));
    };
    const double x = most(0, edge_), y = most(1, edge_ + 1), z = most(2, edge_ + 1);
    return std::sqrt(x * x + y * y + z * z);
  }

 private:
  const std::vector<T>& stored_;
  glm::ivec3 size_;
  int edge_;
  std::array<std::vector<Distance<T>>, 3> largest_;
};

// Returns the bound of each block, value per voxel.
std::vector<float> gradientBoundsOfBlocks(const Volume& volume, int edge, glm::ivec3 count) {
  std::vector<float> slopes(std::size_t(count.x) * count.y * count.z);
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        parallelFor(std::int64_t(count.y) * count.z, 0, [&](std::int64_t begin, std::int64_t end) {
          LineSlopes<T> slopesOfLine(stored, volume.size(), edge);
          for (std::int64_t line = begin; line < end; ++line) {
            slopesOfLine.read(int(line % count.y), int(line / count.y));
            for (int a = 0; a < count.x; ++a)
              slopes[std::size_t(line) * count.x + a] =
                  float(slopesOfLine.slope(a) * std::abs(volume.slope()));
          }
        });
      },
      volume.stored());
  return slopes;
}

}  // namespace

std::size_t gradientBoundEntry(double value, ValueRange range) {
  const double width = double(range.high) - range.low;
  const double place = width > 0 ? (value - range.low) / width * double(entries) : 0;
  return std::size_t(std::clamp(place, 0.0, double(entries - 1)));
}

std::vector<float> gradientBoundsOf(const Volume& volume, const BlockRanges& blockRanges, ValueRange range) {
  const std::vector<float> ofBlocks = gradientBoundsOfBlocks(volume, blockRanges.edge, blockRanges.count);
  std::vector<std::size_t> entryOf;  // entry of each level
  for (float level : blockRanges.levels) entryOf.push_back(gradientBoundEntry(level, range));
  // largest[entries * p + q] is that of blocks whose values reach from entry p to entry q.
  std::vector<float> largest(entries * entries, 0.0f), slopes(entries, 0.0f);
  for (std::size_t n = 0; n < ofBlocks.size(); ++n) {
    float& here = largest[entries * entryOf[blockRanges.lowest[n]] + entryOf[blockRanges.highest[n]]];
    here = std::max(here, ofBlocks[n]);
  }
  for (std::size_t p = 0; p < entries; ++p) {
    float reaching = 0;  // largest over blocks that start at p and reach at least q
    for (std::size_t q = entries; q-- > p;) {
      reaching = std::max(reaching, largest[entries * p + q]);
      slopes[q] = std::max(slopes[q], reaching);
    }
  }
  return slopes;
}

}  // namespace volumen
