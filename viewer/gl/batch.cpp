#include "viewer/gl/batch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

std::int64_t linesOf(std::int64_t samples) { return (samples + Batch::line - 1) / Batch::line; }

}  // namespace

std::int64_t mostSteps(glm::ivec3 size, double stepVoxels) {
  return std::int64_t(std::ceil(glm::length(glm::dvec3(size)) / stepVoxels)) + 1;
}

BatchMaker::BatchMaker(const RayGenerator& setup, glm::ivec2 size, std::int64_t mostSteps)
    : setup_(setup), size_(size) {
  while (widest_ > RayGenerator::padding && linesOf(mostSteps * widest_) > lines_) widest_ /= 2;
  lines_ = std::max(lines_, linesOf(mostSteps * widest_));
}

Strip BatchMaker::nextStrip() {
  const int count = std::min(widest_, size_.x - next_.x);
  Strip strip;
  for (strip.strideLog2 = 4; strip.stride() < count;) ++strip.strideLog2;
  setup_.makeRays(next_.x, next_.y, count, strip.rays);
  const std::int64_t longest = *std::max_element(strip.rays.steps.begin(), strip.rays.steps.end());
  strip.lines = int(linesOf(longest << strip.strideLog2));
  next_.x += count;
  if (next_.x == size_.x) next_ = {0, next_.y + 1};
  return strip;
}

void BatchMaker::fill(Batch& batch) {
  batch.strips.clear();
  batch.lines = batch.rays = 0;
  while (waiting_ || next_.y < size_.y) {
    if (!waiting_) waiting_ = nextStrip();
    const int rays = waiting_->stride();
    if (batch.lines + waiting_->lines > lines_ || batch.rays + rays > Batch::mostRays) return;
    waiting_->firstLine = batch.lines;
    batch.lines += waiting_->lines;
    batch.rays += rays;
    batch.strips.push_back(std::move(*waiting_));
    waiting_.reset();
  }
}

}  // namespace volumen
