#include "viewer/segment/smart_brush.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace volumen {

namespace {

template <class Visit>
void forEachVoxel(const VoxelSpans& spans, const Visit& visit) {
  for (const RowSpan& span : spans)
    for (int i = span.begin; i < span.end; ++i) visit(glm::ivec3(i, span.j, span.k));
}

// The bounding box of some runs, one byte per voxel.
class BoxOfSpans {
 public:
  static constexpr std::uint8_t isOpen = 1, isReached = 2;  // 0 means neither

  explicit BoxOfSpans(const VoxelSpans& spans) : low_(spans.front().begin, spans.front().j, spans.front().k) {
    glm::ivec3 high = low_;
    for (const RowSpan& span : spans) {
      low_ = glm::min(low_, glm::ivec3(span.begin, span.j, span.k));
      high = glm::max(high, glm::ivec3(span.end - 1, span.j, span.k));
    }
    size_ = high - low_ + 1;
    voxels_.resize(std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(size_.z));
  }
  // Returns null outside the box.
  std::uint8_t* at(glm::ivec3 voxel) {
    const glm::ivec3 v = voxel - low_;
    if (glm::any(glm::lessThan(v, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(v, size_)))
      return nullptr;
    return &voxels_[(std::size_t(v.z) * std::size_t(size_.y) + std::size_t(v.y)) * std::size_t(size_.x) +
                    std::size_t(v.x)];
  }

 private:
  glm::ivec3 low_, size_{0};
  std::vector<std::uint8_t> voxels_;
};

}  // namespace

std::optional<ValueRange> valuesUnder(const VoxelSpans& spans, const Volume& volume, double deviations) {
  double first = 0, sum = 0, squares = 0;
  std::int64_t count = 0;
  forEachVoxel(spans, [&](glm::ivec3 v) {
    const double value = double(volume.value(v.x, v.y, v.z));
    if (isPadding(volume.attributes().padding, value)) return;
    if (count++ == 0) first = value;  // sums relative to it keep their digits far from 0
    sum += value - first, squares += (value - first) * (value - first);
  });
  if (count == 0) return {};
  const double mean = sum / double(count);
  const double sd = std::sqrt(std::max(0.0, squares / double(count) - mean * mean));
  return ValueRange{first + mean - deviations * sd, first + mean + deviations * sd};
}

VoxelSpans connectedUnder(const VoxelSpans& spans, const Volume& volume, ValueRange range, glm::ivec3 voxel) {
  if (spans.empty()) return {};
  BoxOfSpans box(spans);
  forEachVoxel(spans, [&](glm::ivec3 v) {
    const double value = double(volume.value(v.x, v.y, v.z));
    if (holds(range, value) && !isPadding(volume.attributes().padding, value))
      *box.at(v) = BoxOfSpans::isOpen;
  });
  std::vector<glm::ivec3> front;
  const auto reach = [&](glm::ivec3 v) {
    std::uint8_t* const state = box.at(v);
    if (!state || *state != BoxOfSpans::isOpen) return;
    *state = BoxOfSpans::isReached;
    front.push_back(v);
  };
  reach(voxel);
  while (!front.empty()) {
    const glm::ivec3 v = front.back();
    front.pop_back();
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        glm::ivec3 next = v;
        next[axis] += step;
        reach(next);
      }
  }
  VoxelSpans found;
  forEachVoxel(spans, [&](glm::ivec3 v) {
    if (*box.at(v) != BoxOfSpans::isReached) return;
    if (!found.empty() && found.back().end == v.x && found.back().j == v.y && found.back().k == v.z)
      ++found.back().end;
    else
      found.push_back({v.x, v.x + 1, v.y, v.z});
  });
  return found;
}

}  // namespace volumen
