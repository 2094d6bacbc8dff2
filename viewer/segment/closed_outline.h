#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace volumen {

/// A closed polygon with the non-zero winding rule. Edges are sorted into bands of y, so that each query
/// tests few.
class ClosedOutline {
 public:
  explicit ClosedOutline(const std::vector<glm::dvec2>& points);
  /// Returns whether a point is inside. NaN is outside.
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
