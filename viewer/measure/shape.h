#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// The tools of slices.md 4, and what points at something and has no number: arrows and labels.
enum class ShapeKind {
  length,
  polyline,
  openCurve,  ///< a smooth curve through its points (SmoothCurve)
  angle,
  cobb,
  bidirectional,   ///< the longest diameter and the longest one at right angles to it (RECIST 1.1, WHO)
  legAxis,         ///< the mechanical axis of a leg: hip, knee and ankle
  cardiothoracic,  ///< the widths of heart and thorax (Danzer, Am J Med Sci 1919; 157: 513)
  ellipse,
  rectangle,
  freehand,
  probe,
  arrow,
  label,
  volume
};

/// The plane that a shape is drawn on. Patient space.
struct ShapePlane {
  glm::dvec3 centre{0};                      ///< any point of it, mm
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< orthogonal unit vectors
  bool operator==(const ShapePlane&) const = default;

  /// right x down.
  glm::dvec3 normal() const;
};

/// A picture as acquired that a shape is drawn on.
struct ShapeFrame {
  std::string instance;  ///< SOPInstanceUID; empty where the file has none
  int number = 0;        ///< its frame, from 0
  bool operator==(const ShapeFrame&) const = default;
};

/// What a tool draws: a plain value, to be kept, written and measured again.
struct Shape {
  ShapeKind kind = ShapeKind::length;
  std::string name;                 ///< of the user's own; may be empty
  std::vector<glm::dvec3> points;   ///< patient mm; on a frame its pixels, z 0; which: ShapeRule
  std::optional<ShapePlane> plane;  ///< regions need one; on a frame the plane of its rows and columns
  ValueRange range;  ///< of `volume`: the segment's values, ends included; they may be infinite
  std::optional<ShapeFrame> frame;  ///< none: it is drawn in the patient
  std::optional<double> softMm{};   /**< its points were picked in 3D: the softest of them lies in a surface
                                       whose middle half of opacity takes so many mm of the line of sight */
  bool operator==(const Shape&) const = default;
};

/// What a kind is called and made of.
struct ShapeRule {
  ShapeKind kind;
  const char* name;
  std::size_t fewest, most;   ///< points
  const char* points;         ///< what they are, in words
  bool region;                ///< an area on a plane
  bool twoLines = false;      ///< the first two points are the ends of one, the others of the other
  bool numberless = false;    ///< it points at something, and says its name
  bool inScene = false;       ///< drawn and seen in 3D, too
  bool acrossSlices = false;  ///< its points may lie on different planes, each of which shows its part
};

/// All kinds.
std::span<const ShapeRule> shapeRules();
const ShapeRule& ruleOf(ShapeKind kind);

/// An Error that names the field where the number of points is not the kind's, a number is not finite, a
/// region has no plane, directions are not orthogonal unit vectors (within 1e-6), the range is upside down,
/// `softMm` is below 0, or a shape of a frame has one, a number below 0, a plane other than ShapePlane{} or
/// is a volume.
Status checkShape(const Shape& shape);

}  // namespace volumen
