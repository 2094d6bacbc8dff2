#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace volumen {

/// A rigid motion from one patient space to another (mm): to = rotation * from + translation.
struct Rigid {
  glm::dmat3 rotation{1};
  glm::dvec3 translation{0};  ///< Translation in mm
  bool operator==(const Rigid&) const = default;

  glm::dvec3 operator()(glm::dvec3 p) const { return rotation * p + translation; }
  Rigid inverse() const {
    const glm::dmat3 back = glm::transpose(rotation);
    return {back, -(back * translation)};
  }
  /// Returns the motion that applies `first`, then this one.
  Rigid after(const Rigid& first) const {
    return {rotation * first.rotation, rotation * first.translation + translation};
  }
};

}  // namespace volumen
