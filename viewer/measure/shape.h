#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// The tools of slices.md 4, and an arrow, which points at something and has no number.
enum class ShapeKind { length, polyline, angle, cobb, ellipse, rectangle, freehand, probe, arrow, volume };

/// The plane that a shape is drawn on. Patient space.
struct ShapePlane {
  glm::dvec3 centre{0};                      ///< any point of it, mm
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< orthogonal unit vectors
  bool operator==(const ShapePlane&) const = default;

  /// right x down.
  glm::dvec3 normal() const;
};

/// What a tool draws: a plain value, to be kept, written and measured again.
struct Shape {
  ShapeKind kind = ShapeKind::length;
  std::string name;                 ///< of the user's own; may be empty
  std::vector<glm::dvec3> points;   ///< patient mm; which: ShapeRule
  std::optional<ShapePlane> plane;  ///< regions need one
  ValueRange range;  ///< of `volume`: the segment's values, ends included; they may be infinite
  bool operator==(const Shape&) const = default;
};

/// What a kind is called and made of.
struct ShapeRule {
  ShapeKind kind;
  const char* name;
  std::size_t fewest, most;  ///< points
  const char* points;        ///< what they are, in words
  bool region;               ///< an area on a plane
};

/// All kinds.
std::span<const ShapeRule> shapeRules();
const ShapeRule& ruleOf(ShapeKind kind);

/// An Error that names the field where the number of points is not the kind's, a number is not finite, a
/// region has no plane, directions are not orthogonal unit vectors (within 1e-6), or the range is upside
/// down.
Status checkShape(const Shape& shape);

}  // namespace volumen
