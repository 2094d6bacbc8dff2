#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// The tools of slices.md 4, plus arrows and labels, which mark something and have no number.
enum class ShapeKind {
  length,
  polyline,
  openCurve,  ///< A smooth curve through its points (SmoothCurve).
  angle,
  cobb,
  bidirectional,   ///< The longest diameter and the longest one at right angles to it (RECIST 1.1, WHO).
  legAxis,         ///< The mechanical axis of a leg: hip, knee and ankle.
  cardiothoracic,  ///< The widths of heart and thorax (Danzer, Am J Med Sci 1919; 157: 513).
  ellipse,
  rectangle,
  freehand,
  probe,
  arrow,
  label,
  volume
};

/// The plane that a shape is drawn on, in patient space.
struct ShapePlane {
  glm::dvec3 centre{0};                      ///< Any point of the plane, mm.
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< Orthogonal unit vectors.
  bool operator==(const ShapePlane&) const = default;

  /// Returns right x down.
  glm::dvec3 normal() const;
};

/// The acquired frame that a shape is drawn on.
struct ShapeFrame {
  std::string instance;  ///< SOPInstanceUID; empty if the file has none.
  int number = 0;        ///< Frame number, from 0.
  bool operator==(const ShapeFrame&) const = default;
};

/// A shape that a tool draws: a plain value that can be kept, written and measured again.
struct Shape {
  ShapeKind kind = ShapeKind::length;
  std::string name;  ///< The user's own name; may be empty.
  /// Points in patient mm, or on a frame in pixels with z = 0. ShapeRule says which.
  std::vector<glm::dvec3> points;
  std::optional<ShapePlane> plane;  ///< Required for regions. On a frame the plane of its rows and columns.
  ValueRange range;                 ///< Range of values of a `volume`, ends included; they may be infinite.
  std::optional<ShapeFrame> frame;  ///< Empty if drawn in the patient.
  /// Softness of the softest point picked in 3D: the length of the line of sight, mm, that holds the middle
  /// half of the opacity.
  std::optional<double> softMm{};
  bool operator==(const Shape&) const = default;
};

/// Name and composition of a kind of shape.
struct ShapeRule {
  ShapeKind kind;
  const char* name;
  std::size_t fewest, most;  ///< Number of points.
  const char* points;        ///< The points in words.
  bool region;               ///< True for areas on a plane.
  bool twoLines = false;    ///< The first two points are the ends of one line, the others those of the other.
  bool numberless = false;  ///< True for shapes that only mark something and show their name.
  bool inScene = false;     ///< True if it can be drawn and shown in 3D too.
  bool acrossSlices = false;  ///< The points may lie on different planes, each of which shows its part.
};

/// Returns the rules of all kinds.
std::span<const ShapeRule> shapeRules();
const ShapeRule& ruleOf(ShapeKind kind);

/// Returns an Error that names the field if
/// - the number of points is not the kind's, a number is not finite, or a coordinate is beyond 1e9 mm,
/// - a region has no plane, or directions are not orthogonal unit vectors (within 1e-6),
/// - the range is reversed, or `softMm` is below 0,
/// - a shape of a frame has `softMm`, a negative number, a plane other than ShapePlane{}, or is a volume.
Status checkShape(const Shape& shape);

}  // namespace volumen
