#include "viewer/segment/between_slices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// The pixels of a slice, x fastest.
struct SlicePlane {
  glm::ivec2 size;
  std::vector<std::uint8_t> in;

  explicit SlicePlane(glm::ivec2 of) : size(of), in(std::size_t(of.x) * std::size_t(of.y)) {}
  std::size_t placeOf(glm::ivec2 p) const {
    return std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x);
  }
  bool holds(glm::ivec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y; }
  bool empty() const { return std::ranges::find(in, 1) == in.end(); }
};

// Metric of a slice: dot products of the steps along its axes, mm^2.
struct PlaneMetric {
  double xx, xy, yy;
  double length(glm::dvec2 d) const {
    return std::sqrt(std::max(0.0, xx * d.x * d.x + 2 * xy * d.x * d.y + yy * d.y * d.y));
  }
};

// Distance to the nearest pixel that is in the mask, or that is not.
class NearestPixel {
 public:
  NearestPixel(const SlicePlane& plane, bool in, const PlaneMetric& metric)
      : size_(plane.size), metric_(metric), before_(plane.in.size()), behind_(plane.in.size()) {
    for (int y = 0; y < size_.y; ++y) {
      int last = none;
      for (int x = 0; x < size_.x; ++x) {
        if (plane.in[plane.placeOf({x, y})] == in) last = x;
        before_[plane.placeOf({x, y})] = last;
      }
      last = none;
      for (int x = size_.x - 1; x >= 0; --x) {
        if (plane.in[plane.placeOf({x, y})] == in) last = x;
        behind_[plane.placeOf({x, y})] = last;
      }
    }
  }

  // Returns the distance in mm, or the diagonal of the slice if there is no such pixel.
  double operator()(glm::ivec2 from) const {
    double best = std::numeric_limits<double>::infinity();
    const double skew = metric_.xy / metric_.xx;
    const double betweenRows = std::sqrt(metric_.yy - skew * metric_.xy);
    const int rows = std::max(from.y, size_.y - 1 - from.y);
    for (int n = 0; n <= rows && n * betweenRows < best; ++n) {
      best = std::min(best, inRow(from, n, skew));
      if (n > 0) best = std::min(best, inRow(from, -n, skew));
    }
    return std::isinf(best) ? metric_.length(size_) : best;
  }

 private:
  static constexpr int none = -1;

  double inRow(glm::ivec2 from, int dy, double skew) const {
    const int y = from.y + dy;
    double best = std::numeric_limits<double>::infinity();
    if (y < 0 || y >= size_.y) return best;
    const auto row = std::size_t(y) * std::size_t(size_.x);
    const auto consider = [&](int x) {
      if (x != none) best = std::min(best, metric_.length({x - from.x, dy}));
    };
    // Position on this row that is nearest to `from` on a sheared grid.
    const double nearest = std::clamp(from.x - skew * dy, -1.0, double(size_.x));
    const int at = int(std::floor(nearest));
    if (at >= 0) consider(before_[row + std::size_t(std::min(at, size_.x - 1))]);
    if (at + 1 < size_.x) consider(behind_[row + std::size_t(at + 1)]);
    return best;
  }

  glm::ivec2 size_;
  PlaneMetric metric_;
  std::vector<int> before_, behind_;  // nearest such pixel in the row, this pixel included
};

// Connected components of a slice (8-connected), numbered from 1; `of` is 0 elsewhere.
struct PlaneParts {
  struct Part {
    std::vector<glm::ivec2> pixels;
    bool overlaps = false;
    glm::dvec2 middle() const {
      glm::dvec2 sum(0);
      for (const glm::ivec2 p : pixels) sum += p;
      return sum / double(pixels.size());
    }
  };
  std::vector<int> of;
  std::vector<Part> parts;

  explicit PlaneParts(const SlicePlane& plane) : of(plane.in.size()) {
    for (int y = 0; y < plane.size.y; ++y)
      for (int x = 0; x < plane.size.x; ++x) {
        std::vector<glm::ivec2> pixels;
        const auto reach = [&](glm::ivec2 p) {
          if (!plane.holds(p) || !plane.in[plane.placeOf(p)] || of[plane.placeOf(p)]) return;
          of[plane.placeOf(p)] = int(parts.size()) + 1;
          pixels.push_back(p);
        };
        reach({x, y});
        for (std::size_t n = 0; n < pixels.size(); ++n) {
          const glm::ivec2 p = pixels[n];
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) reach(p + glm::ivec2(dx, dy));
        }
        if (!pixels.empty()) parts.push_back({std::move(pixels), false});
      }
  }

  // Returns the components that overlap nothing, largest first, in order of discovery if equal.
  std::vector<Part*> apart() {
    std::vector<Part*> found;
    for (Part& part : parts)
      if (!part.overlaps) found.push_back(&part);
    std::ranges::stable_sort(found, std::greater(), [](const Part* part) { return part->pixels.size(); });
    return found;
  }
};

// One pixel position filled in the slices first .. last.
struct FilledVoxels {
  glm::ivec2 at;
  int first, last;
};

// Fills the slices from + 1 .. to - 1 between two painted slices.
class SliceGap {
 public:
  SliceGap(int from, int to, const PlaneMetric& metric, glm::ivec2 size)
      : from_(from), to_(to), metric_(metric), size_(size) {}

  std::vector<FilledVoxels> filled(SlicePlane first, SlicePlane second, const CancelToken& cancel) {
    PlaneParts firstParts(first), secondParts(second);
    for (std::size_t n = 0; n < first.in.size(); ++n)
      if (first.in[n] && second.in[n])
        firstParts.parts[std::size_t(firstParts.of[n] - 1)].overlaps =
            secondParts.parts[std::size_t(secondParts.of[n] - 1)].overlaps = true;
    std::vector<PlaneParts::Part*> others = secondParts.apart();
    for (const PlaneParts::Part* part : firstParts.apart()) {
      if (others.empty() || cancel.cancelled()) break;
      const auto distance = [&](const PlaneParts::Part* other) {
        return metric_.length(other->middle() - part->middle());
      };
      const auto nearest = std::ranges::min_element(others, {}, distance);
      move(*part, **nearest);
      for (const glm::ivec2 p : part->pixels) first.in[first.placeOf(p)] = 0;
      for (const glm::ivec2 p : (*nearest)->pixels) second.in[second.placeOf(p)] = 0;
      others.erase(nearest);
    }
    if (!first.empty() && !second.empty()) fill(first, second, glm::ivec2(0), glm::ivec2(0));
    return std::move(filled_);
  }

 private:
  // Morphs one component into the other while moving it from centroid to centroid.
  void move(const PlaneParts::Part& part, const PlaneParts::Part& other) {
    const glm::ivec2 by = glm::round(other.middle() - part.middle());
    glm::ivec2 low = part.pixels.front(), high = low;
    const auto take = [&](glm::ivec2 p) { low = glm::min(low, p), high = glm::max(high, p); };
    for (const glm::ivec2 p : part.pixels) take(p);
    for (const glm::ivec2 p : other.pixels) take(p - by);
    low -= 1;
    SlicePlane first(high - low + 2), second(high - low + 2);
    for (const glm::ivec2 p : part.pixels) first.in[first.placeOf(p - low)] = 1;
    for (const glm::ivec2 p : other.pixels) second.in[second.placeOf(p - by - low)] = 1;
    fill(first, second, low, by);
  }

  // Pixel p of both planes lies at p + origin in the first slice and at p + origin + by in the second.
  void fill(const SlicePlane& first, const SlicePlane& second, glm::ivec2 origin, glm::ivec2 by) {
    const NearestPixel outOfFirst(first, false, metric_), outOfSecond(second, false, metric_);
    const NearestPixel inFirst(first, true, metric_), inSecond(second, true, metric_);
    for (int y = 0; y < first.size.y; ++y)
      for (int x = 0; x < first.size.x; ++x) {
        const glm::ivec2 p(x, y);
        const bool a = first.in[first.placeOf(p)], b = second.in[second.placeOf(p)];
        if (!a && !b) continue;
        double inside = 0, outside = 0;  // mm
        if (a != b) {
          inside = a ? outOfFirst(p) : outOfSecond(p);
          outside = a ? inSecond(p) : inFirst(p);
        }
        int begin = from_ + 1, end = to_;
        // The tolerance counts sums of 0 as inside, whatever the rounding.
        const auto isIn = [&](int slice) {
          const double away = double(a ? slice - from_ : to_ - slice) / (to_ - from_);
          return away * outside - (1 - away) * inside <= 1e-9 * (outside + inside);
        };
        while (a && begin < end && !isIn(end - 1)) --end;
        while (!a && begin < end && !isIn(begin)) ++begin;
        put(p + origin, by, begin, end);
      }
  }

  void put(glm::ivec2 at, glm::ivec2 by, int begin, int end) {
    if (by == glm::ivec2(0)) {
      if (begin < end) keep(at, begin, end - 1);
      return;
    }
    for (int slice = begin; slice < end; ++slice) {
      const double share = double(slice - from_) / (to_ - from_);
      keep(at + glm::ivec2(glm::round(share * glm::dvec2(by))), slice, slice);
    }
  }

  void keep(glm::ivec2 at, int first, int last) {
    if (at.x >= 0 && at.y >= 0 && at.x < size_.x && at.y < size_.y) filled_.push_back({at, first, last});
  }

  const int from_, to_;
  const PlaneMetric metric_;
  const glm::ivec2 size_;
  std::vector<FilledVoxels> filled_;
};

// Access to the slices of a mask across an axis.
class SlicesAcross {
 public:
  SlicesAcross(glm::ivec3 size, int axis)
      : axis_(axis),
        x_(axis == 0 ? 1 : 0),
        y_(axis == 2 ? 1 : 2),
        count_(size[axis]),
        size_(size[x_], size[y_]) {}

  glm::ivec2 size() const { return size_; }
  glm::ivec3 voxel(int slice, glm::ivec2 p) const {
    glm::ivec3 v;
    v[axis_] = slice, v[x_] = p.x, v[y_] = p.y;
    return v;
  }
  PlaneMetric metric(const VoxelGeometry& geometry) const {
    const glm::dvec3 x = geometry.patientFromVoxelStep[x_], y = geometry.patientFromVoxelStep[y_];
    return {glm::dot(x, x), glm::dot(x, y), glm::dot(y, y)};
  }
  SlicePlane plane(const BitMask& mask, int slice) const {
    SlicePlane plane(size_);
    for (int y = 0; y < size_.y; ++y)
      for (int x = 0; x < size_.x; ++x) plane.in[plane.placeOf({x, y})] = mask.at(voxel(slice, {x, y}));
    return plane;
  }
  // Returns the slices with voxels, in order.
  std::vector<int> painted(const BitMask& mask) const {
    std::vector<bool> any(std::size_t(count_), false);
    for (int k = 0; k < mask.size().z; ++k)
      for (int j = 0; j < mask.size().y; ++j) {
        const auto row = mask.row(j, k);
        for (std::size_t n = 0; n < row.size(); ++n)
          for (std::uint64_t word = row[n]; word; word &= word - 1) {
            any[std::size_t(axis_ == 0 ? 64 * int(n) + std::countr_zero(word) : axis_ == 1 ? j : k)] = true;
            if (axis_ != 0) break;
          }
      }
    std::vector<int> found;
    for (int slice = 0; slice < count_; ++slice)
      if (any[std::size_t(slice)]) found.push_back(slice);
    return found;
  }

 private:
  int axis_, x_, y_, count_;
  glm::ivec2 size_;
};

}  // namespace

BitMask filledBetweenSlices(const BitMask& mask, int axis, const CancelToken& cancel) {
  const SlicesAcross slices(mask.size(), axis);
  const std::vector<int> painted = slices.painted(mask);
  if (painted.size() < 2) return mask;
  std::vector<std::vector<FilledVoxels>> filled(painted.size() - 1);
  parallelFor(std::int64_t(filled.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = std::size_t(begin); n < std::size_t(end) && !cancel.cancelled(); ++n) {
      const int from = painted[n], to = painted[n + 1];
      if (to == from + 1) continue;
      SliceGap gap(from, to, slices.metric(mask.geometry()), slices.size());
      filled[n] = gap.filled(slices.plane(mask, from), slices.plane(mask, to), cancel);
    }
  });
  BitMask result = mask;
  for (const auto& gap : filled)
    for (const FilledVoxels& one : gap)
      for (int slice = one.first; slice <= one.last; ++slice) result.set(slices.voxel(slice, one.at));
  return result;
}

std::optional<int> axisOfPaintedSlices(const BitMask& mask) {
  std::optional<int> found;
  std::size_t fewest = 0;
  for (const int axis : {2, 1, 0}) {
    const std::vector<int> painted = SlicesAcross(mask.size(), axis).painted(mask);
    const bool areApart = !painted.empty() && std::size_t(painted.back() - painted.front()) >= painted.size();
    if (areApart && (!found || painted.size() < fewest)) found = axis, fewest = painted.size();
  }
  return found;
}

}  // namespace volumen
