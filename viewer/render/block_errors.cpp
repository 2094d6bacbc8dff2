#include "viewer/render/block_errors.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace volumen {

void BlockErrors::beginBlock(double chance) { blocks_.push_back({1 / chance}); }

void BlockErrors::add(const glm::dvec4& off, bool shows) {
  Block& b = blocks_.back();
  b.sum += off;
  ++b.pixels;
  if (!shows) return;
  ++shown_;
  shownInAll_ += b.weight;
  squaresOfShown_ += b.weight * glm::dot(off, off) / components_;
}

BlockErrors::Bounds BlockErrors::worst() const {
  constexpr double deviations = 2;
  double weights = 0, squares = 0, squaresDeviate = 0;
  glm::dvec4 mean(0), meanDeviates(0);
  for (const Block& b : blocks_) {
    const glm::dvec4 off = b.sum / double(std::max(1, b.pixels));
    const double square = glm::dot(off, off) / components_;
    weights += b.weight;
    squares += b.weight * square;
    squaresDeviate += b.weight * b.weight * square * square;
    mean += b.weight * off;
    meanDeviates += b.weight * b.weight * off * off;
  }
  if (!(weights > 0)) return {};
  const glm::dvec4 most = (glm::abs(mean) + deviations * glm::sqrt(meanDeviates)) / weights;
  return {std::sqrt((squares + deviations * std::sqrt(squaresDeviate)) / weights),
          std::max({most.r, most.g, most.b, most.a}),
          shown_ > 0 ? std::sqrt(squaresOfShown_ / shownInAll_) : 0};
}

}  // namespace volumen
