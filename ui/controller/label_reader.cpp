#include "ui/controller/label_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace volumen {

namespace {

constexpr int brickEdge = LabelMap::edge;

// Voxel coordinates in units of 2^-32, so that steps add up exactly however a line is divided.
using Fixed = glm::vec<3, std::int64_t>;

Fixed fixedOf(glm::dvec3 v) {
  constexpr double one = 4294967296.0;
  return {std::llround(v.x * one), std::llround(v.y * one), std::llround(v.z * one)};
}

// Returns the index within its brick of the voxel that contains a point.
unsigned placeInBrick(const Fixed& v) {
  constexpr unsigned edge = brickEdge;
  return unsigned(v.x >> 32) % edge +
         edge * (unsigned(v.y >> 32) % edge + edge * (unsigned(v.z >> 32) % edge));
}

// Returns the least number of positive steps that cover a distance.
std::int64_t stepsTo(std::int64_t far, std::int64_t step) { return far <= 0 ? 0 : (far + step - 1) / step; }

// The labels of the eight voxels around a point, one byte each, i fastest.
using Eight = std::uint64_t;

bool areSame(Eight labels) { return labels == (labels >> 8 | labels << 56); }

const LabelMap::Brick& brickOf(const LabelMap& map, glm::ivec3 voxel) {
  const glm::ivec3 at = voxel / brickEdge, count = map.bricks();
  return map.brick(std::size_t(at.x) +
                   std::size_t(count.x) * (std::size_t(at.y) + std::size_t(count.y) * std::size_t(at.z)));
}

// A box of base voxels whose eight neighbours lie in the same bricks: within one brick except its last
// voxels, or between two bricks.
class EightBricks {
 public:
  // Starts at the eight voxels from `first` on.
  EightBricks(const LabelMap& map, glm::ivec3 first) {
    const glm::ivec3 last = map.geometry().size - 1, count = map.bricks();
    // For the near and far voxels along each axis: their brick and the position within it.
    std::array<std::array<std::size_t, 2>, 3> bricks, places;
    std::size_t brickOn = 1, placeOn = 1;
    isOneBrick_ = true;
    for (int a = 0; a < 3; ++a) {
      auto &brick = bricks[std::size_t(a)], &place = places[std::size_t(a)];
      for (int far = 0; far < 2; ++far) {
        const auto v = std::size_t(std::clamp(first[a] + far, 0, last[a]));
        brick[std::size_t(far)] = v / brickEdge * brickOn, place[std::size_t(far)] = v % brickEdge * placeOn;
      }
      isOneBrick_ = isOneBrick_ && place[1] > place[0];
      brickOn *= std::size_t(count[a]), placeOn *= brickEdge;
    }
    for (std::size_t c = 0; c < (isOneBrick_ ? 1 : 8); ++c) {
      const std::size_t i = c & 1, j = c >> 1 & 1, k = c >> 2;
      const LabelMap::Brick& brick = map.brick(bricks[0][i] + bricks[1][j] + bricks[2][k]);
      labels_[c] = brick.voxels ? &(*brick.voxels)[places[0][i] + places[1][j] + places[2][k]] : &brick.label;
      masks_[c] = brick.voxels ? -1 : 0;
    }
  }

  bool areOneLabel() const {
    bool isOne = masks_[0] == 0;
    for (std::size_t c = 1; c < (isOneBrick_ ? 1 : 8); ++c)
      isOne = isOne && masks_[c] == 0 && *labels_[c] == *labels_[0];
    return isOne;
  }
  std::uint8_t firstLabel() const { return *labels_[0]; }

  // Returns whether all eight lie in one brick.
  bool areOfOneBrick() const { return isOneBrick_; }
  // Returns the eight at offset `far` from the first ones in one brick.
  Eight ofOneBrick(std::ptrdiff_t far) const {
    constexpr std::ptrdiff_t row = brickEdge, slice = brickEdge * brickEdge;
    const auto pair = [from = labels_[0] + far](std::ptrdiff_t n) {
      std::uint16_t two;
      std::memcpy(&two, from + n, 2);
      return Eight(two);
    };
    return pair(0) | pair(row) << 16 | pair(slice) << 32 | pair(slice + row) << 48;
  }
  // Returns the eight at offset `far` if they lie in several bricks.
  Eight ofBricks(std::ptrdiff_t far) const {
    Eight eight = 0;
    for (std::size_t c = 0; c < 8; ++c) eight |= Eight(labels_[c][far & masks_[c]]) << 8 * c;
    return eight;
  }

 private:
  std::array<const std::uint8_t*, 8> labels_{};  // of the first eight; within one brick, only of the first
  std::array<std::ptrdiff_t, 8> masks_{};        // 0 if the brick has one label
  bool isOneBrick_;
};

}  // namespace

// Points on a straight line.
struct LabelReader::Line {
  Fixed first, step;

  Line from(std::int64_t n) const { return {first + n * step, step}; }
  // Returns the range of the first `count` points within a box; `high` is exclusive.
  std::pair<std::int64_t, std::int64_t> within(glm::ivec3 low, glm::ivec3 high, std::int64_t count) const {
    std::int64_t from = 0, to = count;
    for (int a = 0; a < 3; ++a) {
      const std::int64_t below = (std::int64_t(low[a]) << 32) - first[a],
                         above = (std::int64_t(high[a]) << 32) - first[a];
      if (step[a] > 0)
        from = std::max(from, stepsTo(below, step[a])), to = std::min(to, stepsTo(above, step[a]));
      if (step[a] < 0)
        from = std::max(from, stepsTo(1 - above, -step[a])), to = std::min(to, stepsTo(1 - below, -step[a]));
      if (step[a] == 0 && (below > 0 || above <= 0)) to = 0;
    }
    return {from, to};
  }
};

// Finds the number with the largest share at many points at once.
class LabelReader::Shares {
 public:
  Shares(std::span<std::uint8_t> numbers, const std::array<std::uint8_t, 256>& shownAs)
      : numbers_(numbers), shownAs_(shownAs) {}

  // Adds point `n`; `v` is measured from voxel centres.
  void find(std::size_t n, Eight around, const Fixed& v) {
    if (areSame(around)) {
      numbers_[n] = shownAs_[around & 255];
      return;
    }
    eights_[count_] = around;
    for (int a = 0; a < 3; ++a) far_[std::size_t(a)][count_] = std::uint16_t(std::uint32_t(v[a]) >> 17);
    places_[count_] = n;
    if (++count_ == most) finish();
  }
  void finish();

 private:
  static constexpr std::size_t most = 16;  // two vectors, so that loops are unrolled
  template <class T>
  using Lanes = std::array<T, most>;

  void weigh(std::array<Lanes<std::uint16_t>, 8>& weights) const;

  std::span<std::uint8_t> numbers_;
  const std::array<std::uint8_t, 256>& shownAs_;
  std::size_t count_ = 0;
  Lanes<Eight> eights_{};
  std::array<Lanes<std::uint16_t>, 3> far_{};  // distances from the nearer voxels along each axis, 2^-15
  Lanes<std::size_t> places_{};
};

// Computes the weights of the eight voxels in units of 2^-13.
void LabelReader::Shares::weigh(std::array<Lanes<std::uint16_t>, 8>& weights) const {
  constexpr std::uint16_t whole = 1 << 15;
  const auto part = [&](std::size_t far, std::size_t axis, std::size_t n) {
    return far ? far_[axis][n] : std::uint16_t(whole - far_[axis][n]);
  };
  const auto product = [](unsigned a, unsigned b) { return std::uint16_t(a * b >> 16); };
  for (std::size_t pair = 0; pair < 4; ++pair)
    for (std::size_t n = 0; n < most; ++n) {
      const std::uint16_t both = product(part(pair & 1, 1, n), part(pair >> 1, 2, n));
      weights[2 * pair][n] = product(part(0, 0, n), both);
      weights[2 * pair + 1][n] = product(part(1, 0, n), both);
    }
}

void LabelReader::Shares::finish() {
  std::array<Lanes<std::uint16_t>, 8> around, weights;
  for (std::size_t n = 0; n < most; ++n)
    for (std::size_t c = 0; c < 8; ++c) around[c][n] = shownAs_[eights_[n] >> 8 * c & 255];
  weigh(weights);
  // Among voxels with the same number the last one gets their full share, those before it a part. Values are
  // read before the selection, so that the loops are vectorised.
  auto shares = weights;
  Lanes<std::uint16_t> largest{}, first;
  for (std::size_t d = 0; d < 8; ++d) {
    for (std::size_t c = 0; c < d; ++c)
      for (std::size_t n = 0; n < most; ++n) {
        const std::uint16_t weight = weights[c][n];
        shares[d][n] = std::uint16_t(shares[d][n] + (around[c][n] == around[d][n] ? weight : 0));
      }
    for (std::size_t n = 0; n < most; ++n) largest[n] = shares[d][n] > largest[n] ? shares[d][n] : largest[n];
  }
  constexpr std::uint16_t background = 256;  // greater than all others
  first.fill(background);
  for (std::size_t d = 0; d < 8; ++d)
    for (std::size_t n = 0; n < most; ++n) {
      const std::uint16_t number = around[d][n] == 0 ? background : around[d][n], before = first[n];
      const std::uint16_t met = shares[d][n] == largest[n] ? number : background;
      first[n] = met < before ? met : before;
    }
  for (std::size_t n = 0; n < count_; ++n) numbers_[places_[n]] = std::uint8_t(first[n]);
  count_ = 0;
}

LabelReader::LabelReader(const SegmentLayer& layer, const SlicePlane& plane)
    : map_(*layer.labels),
      toPlane_(layer.fromPlane.inverse()),
      nearest_(plane.interpolation == Interpolation::nearest) {
  for (std::size_t n = 0; n < layer.shown.size(); ++n)
    shownAs_[layer.shown[n].segment & 255] = std::uint8_t(n + 1);
  const auto voxelAt = [&](double x, double y) {
    return map_.geometry().voxelFromPatient(layer.fromPlane(plane.patientFromPixel({x, y})));
  };
  first_ = voxelAt(0, 0), right_ = voxelAt(1, 0) - first_, down_ = voxelAt(0, 1) - first_;
  low_ = map_.geometry().size, high_ = glm::ivec3(0);
  std::size_t n = 0;
  for (int k = 0; k < map_.bricks().z; ++k)
    for (int j = 0; j < map_.bricks().y; ++j)
      for (int i = 0; i < map_.bricks().x; ++i) {
        const LabelMap::Brick& brick = map_.brick(n++);
        if (!brick.voxels && shownAs_[brick.label] == 0) continue;
        const glm::ivec3 corner = glm::ivec3(i, j, k) * brickEdge;
        low_ = glm::min(low_, corner);
        high_ = glm::max(high_, glm::min(corner + brickEdge, map_.geometry().size));
      }
}

glm::dvec2 LabelReader::voxelsPerPixel() const { return {glm::length(right_), glm::length(down_)}; }

std::vector<glm::dvec3> LabelReader::corners() const {
  std::vector<glm::dvec3> corners;
  const double beyond = nearest_ ? 0.5 : 1;  // the centres of the outermost voxels
  for (int c = 0; c < 8 && low_.x < high_.x; ++c) {
    const glm::dvec3 low = glm::dvec3(low_) - beyond, high = glm::dvec3(high_ - 1) + beyond;
    const glm::dvec3 corner(c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z);
    corners.push_back(toPlane_(map_.geometry().patientFromVoxel(corner)));
  }
  return corners;
}

void LabelReader::read(glm::dvec2 pFirst, double step, std::span<std::uint8_t> numbers) const {
  constexpr double farthest = 1 << 30;  // voxels
  const glm::dvec3 first = first_ + pFirst.x * right_ + pFirst.y * down_ + 0.5, on = step * right_;
  const glm::dvec3 reach = glm::abs(first) + double(numbers.size()) * glm::abs(on);
  if (!(std::max({reach.x, reach.y, reach.z}) < farthest)) return;
  const Line line{fixedOf(first), fixedOf(on)};
  nearest_ ? readNearest(line, numbers) : readLargest(line, numbers);
}

void LabelReader::readNearest(const Line& line, std::span<std::uint8_t> numbers) const {
  auto [from, to] = line.within(low_, high_, std::int64_t(numbers.size()));
  while (from < to) {
    const Line rest = line.from(from);
    const glm::ivec3 corner = glm::ivec3(rest.first >> std::int64_t(32)) & ~(brickEdge - 1);
    const std::int64_t count = rest.within(corner, corner + brickEdge, to - from).second;
    const LabelMap::Brick& brick = brickOf(map_, corner);
    std::uint8_t* const out = &numbers[std::size_t(from)];
    if (!brick.voxels) std::fill_n(out, count, shownAs_[brick.label]);
    Fixed v = rest.first;
    for (std::int64_t n = 0; brick.voxels && n < count; ++n, v += rest.step)
      out[n] = shownAs_[(*brick.voxels)[placeInBrick(v)]];
    from += count;
  }
}

// Reads along a line with bricks and the eight voxels reused while points stay between them. Beyond the grid
// its last voxel counts.
void LabelReader::readLargest(const Line& line, std::span<std::uint8_t> numbers) const {
  auto [from, to] = line.within(glm::max(low_ - 1, 0), glm::min(high_ + 1, map_.geometry().size),
                                std::int64_t(numbers.size()));
  // Rounded to the precision of Shares.
  constexpr std::int64_t toCentres = (1LL << 31) - (1LL << 16);
  Shares shares(numbers, shownAs_);
  while (from < to) {
    Line rest = line.from(from);
    rest.first -= toCentres;
    const glm::ivec3 first(rest.first >> std::int64_t(32)),
        last = glm::min(first | (brickEdge - 1), map_.geometry().size - 1);
    glm::ivec3 low, high;
    for (int a = 0; a < 3; ++a) {
      const bool isBetween = first[a] < 0 || first[a] == last[a];
      low[a] = isBetween ? first[a] : first[a] & ~(brickEdge - 1),
      high[a] = isBetween ? first[a] + 1 : last[a];
    }
    const std::int64_t count = rest.within(low, high, to - from).second;
    const EightBricks bricks(map_, first);
    if (bricks.areOneLabel()) {
      std::fill_n(&numbers[std::size_t(from)], count, shownAs_[bricks.firstLabel()]);
    } else {
      const auto follow = [&](const auto& eightAt) {
        const unsigned start = placeInBrick(rest.first);
        unsigned read = start;
        Eight eight = eightAt(0);
        for (std::int64_t n = from; n < from + count; ++n, rest.first += rest.step) {
          if (const unsigned place = placeInBrick(rest.first); place != read)
            read = place, eight = eightAt(std::ptrdiff_t(place) - std::ptrdiff_t(start));
          shares.find(std::size_t(n), eight, rest.first);
        }
      };
      bricks.areOfOneBrick() ? follow([&](std::ptrdiff_t far) { return bricks.ofOneBrick(far); })
                             : follow([&](std::ptrdiff_t far) { return bricks.ofBricks(far); });
    }
    from += count;
  }
  shares.finish();
}

}  // namespace volumen
