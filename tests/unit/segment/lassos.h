#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "viewer/segment/mask.h"

namespace volumen::tests {

/// Returns a freehand outline: a ragged ring that may cross itself.
inline Lasso anyLasso(std::mt19937& random, bool perspective, bool inside) {
  std::uniform_real_distribution<double> one(-1, 1);
  Lasso lasso;
  const glm::dvec3 forward = glm::normalize(glm::dvec3(one(random), one(random), one(random)));
  lasso.right = glm::normalize(glm::cross(forward, glm::dvec3(one(random), one(random), one(random))));
  lasso.down = glm::cross(forward, lasso.right);
  lasso.perspective = perspective;
  lasso.inside = inside;
  lasso.origin = perspective ? -40.0 * forward + glm::dvec3(one(random)) : glm::dvec3(one(random));
  const int count = 3 + int(random() % 60);
  const double size = perspective ? 0.2 : 7;
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * std::numbers::pi * n / count, radius = size * (0.75 + 0.5 * one(random));
    lasso.points.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)) + 0.2 * size * one(random));
  }
  return lasso;
}

/// Returns the winding number of the outline about a point, from the angles between its corners.
inline int windingByAngles(const std::vector<glm::dvec2>& points, glm::dvec2 p) {
  double sum = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const glm::dvec2 a = points[n] - p, b = points[(n + 1) % points.size()] - p;
    sum += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return int(std::lround(sum / (2 * std::numbers::pi)));
}

/// Returns by brute force whether a lasso cuts away a point in patient space.
inline bool isCutBy(const Lasso& lasso, glm::dvec3 p) {
  const glm::dvec3 d = p - lasso.origin, forward = glm::cross(lasso.right, lasso.down);
  glm::dvec2 seen(glm::dot(d, lasso.right), glm::dot(d, lasso.down));
  bool isInside = true;
  if (lasso.perspective) {
    isInside = glm::dot(d, forward) > 0;
    seen /= glm::dot(d, forward);
  }
  return (isInside && windingByAngles(lasso.points, seen) != 0) == lasso.inside;
}

}  // namespace volumen::tests
