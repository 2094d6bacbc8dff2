#include "viewer/segment/closed_outline.h"

#include <algorithm>
#include <glm/common.hpp>

namespace volumen {

ClosedOutline::ClosedOutline(const std::vector<glm::dvec2>& points) {
  if (points.empty()) return;
  low_ = high_ = points.front();
  for (const glm::dvec2 p : points) low_ = glm::min(low_, p), high_ = glm::max(high_, p);
  bands_.resize(std::clamp(points.size(), std::size_t(1), std::size_t(512)));
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Edge edge{points[n], points[(n + 1) % points.size()]};
    const std::size_t from = bandOf(edge.from.y), to = bandOf(edge.to.y);
    for (std::size_t band = std::min(from, to); band <= std::max(from, to); ++band)
      bands_[band].push_back(edge);
  }
}

bool ClosedOutline::holds(glm::dvec2 p) const {
  // Written so that NaN lies outside.
  if (bands_.empty() || !(p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y)) return false;
  int winding = 0;
  for (const Edge& edge : bands_[bandOf(p.y)]) {
    const bool up = edge.from.y <= p.y;
    if (up == (edge.to.y <= p.y)) continue;
    const glm::dvec2 along = edge.to - edge.from, to = p - edge.from;
    const double side = along.x * to.y - along.y * to.x;
    if (up ? side > 0 : side < 0) winding += up ? 1 : -1;
  }
  return winding != 0;
}

std::size_t ClosedOutline::bandOf(double y) const {
  const double height = high_.y - low_.y;
  const double part = height > 0 ? (y - low_.y) / height : 0;
  return std::min(std::size_t(part * double(bands_.size())), bands_.size() - 1);
}

}  // namespace volumen
