#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace volumen {

/// An outline whose last point is joined to the first; where it crosses itself, all that it goes around is
/// inside (non-zero winding number). Its edges are sorted into bands of y, so that a point meets few of them.
class ClosedOutline {
 public:
  explicit ClosedOutline(const std::vector<glm::dvec2>& points);
  /// Whether a point is inside; what is no number is not.
  bool holds(glm::dvec2 p) const;

 private:
  struct Edge {
    glm::dvec2 from, to;
  };
  std::size_t bandOf(double y) const;

  glm::dvec2 low_{0}, high_{0};
  std::vector<std::vector<Edge>> bands_;
};

}  // namespace volumen
