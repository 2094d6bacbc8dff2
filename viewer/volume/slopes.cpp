#include "viewer/volume/slopes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr std::size_t entries = 256;

// The largest differences between neighbours along x, y and z in one line of blocks (b, c), its upper faces
// included, by i: entry i of x lies between i and i + 1.
template <class T>
class LineSlopes {
  using Difference = std::conditional_t<std::is_floating_point_v<T>, float, std::int32_t>;

 public:
  LineSlopes(const std::vector<T>& stored, glm::ivec3 size, int edge)
      : stored_(stored), size_(size), edge_(edge) {
    for (auto& d : largest_) d.resize(std::size_t(size.x) + edge);
  }

  void read(int b, int c) {
    for (auto& d : largest_) std::fill(d.begin(), d.end(), Difference(0));
    const int lastRow = std::min(b * edge_ + edge_, size_.y - 1),
              lastSlice = std::min(c * edge_ + edge_, size_.z - 1);
    for (int k = c * edge_; k <= lastSlice; ++k)
      for (int j = b * edge_; j <= lastRow; ++j) {
        const T* row = stored_.data() + (std::size_t(k) * size_.y + j) * std::size_t(size_.x);
        takeIn(row, row + 1, size_.x - 1, largest_[0]);
        if (j < lastRow) takeIn(row, row + size_.x, size_.x, largest_[1]);
        if (k < lastSlice) takeIn(row, row + std::size_t(size_.x) * size_.y, size_.x, largest_[2]);
      }
  }

  // Of block a of the line, in stored units a voxel.
  double slope(int a) const {
    const auto most = [&](int axis, int count) {
      const auto first = largest_[axis].begin() + a * edge_;
      return double(*std::max_element(first, first + count));
    };
    return std::hypot(most(0, edge_), most(1, edge_ + 1), most(2, edge_ + 1));
  }

 private:
  static void takeIn(const T* here, const T* next, int count, std::vector<Difference>& largest) {
    Difference* most = largest.data();
    for (int i = 0; i < count; ++i) {
      const Difference d = Difference(next[i]) - Difference(here[i]);
      most[i] = std::max(most[i], std::max(d, -d));
    }
  }

  const std::vector<T>& stored_;
  glm::ivec3 size_;
  int edge_;
  std::array<std::vector<Difference>, 3> largest_;
};

// Of each block, value per voxel.
std::vector<float> slopesOfBlocks(const Volume& volume, int edge, glm::ivec3 count) {
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

std::size_t slopeEntry(double value, ValueRange range) {
  const double width = double(range.high) - range.low;
  const double place = width > 0 ? (value - range.low) / width * double(entries) : 0;
  return std::size_t(std::clamp(place, 0.0, double(entries - 1)));
}

std::vector<float> slopesOf(const Volume& volume, const BrickRanges& bricks, ValueRange range) {
  const std::vector<float> ofBlocks = slopesOfBlocks(volume, bricks.edge, bricks.count);
  // largest[entries * p + q]: of the blocks whose values reach from entry p to entry q.
  std::vector<float> largest(entries * entries, 0.0f), slopes(entries, 0.0f);
  for (std::size_t n = 0; n < ofBlocks.size(); ++n) {
    float& here = largest[entries * slopeEntry(bricks.low(n), range) + slopeEntry(bricks.high(n), range)];
    here = std::max(here, ofBlocks[n]);
  }
  for (std::size_t p = 0; p < entries; ++p) {
    float reaching = 0;  // of the blocks from p that reach as far as q
    for (std::size_t q = entries; q-- > p;) {
      reaching = std::max(reaching, largest[entries * p + q]);
      slopes[q] = std::max(slopes[q], reaching);
    }
  }
  return slopes;
}

}  // namespace volumen
