#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace volumen {

/// A motion that keeps all lengths, from one patient space (mm) to another: to = rotation * from +
/// translation.
struct Rigid {
  glm::dmat3 rotation{1};
  glm::dvec3 translation{0};  ///< mm
  bool operator==(const Rigid&) const = default;

  glm::dvec3 operator()(glm::dvec3 p) const { return rotation * p + translation; }
  Rigid inverse() const {
    const glm::dmat3 back = glm::transpose(rotation);
    return {back, -(back * translation)};
  }
  /// First `first`, then this.
  Rigid after(const Rigid& first) const {
    return {rotation * first.rotation, rotation * first.translation + translation};
  }
};

}  // namespace volumen
