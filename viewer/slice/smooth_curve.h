#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// A smooth open curve through points, measured by arc length. It consists of cubic pieces (Catmull and Rom
/// 1974) with centripetal knots, which form neither loops nor cusps within a piece (Yuksel, Schaefer and
/// Keyser, Computer-Aided Design 43 (2011) 747-755). Its ends follow the parabola through the three outer
/// points; two points give a straight line. Lengths are in the unit of the coordinates, mm in the patient.
class SmoothCurve {
 public:
  /// Creates the curve through these points in order; repeated points are skipped. The Error means: a
  /// coordinate is not finite or above 1e9, or fewer than two points remain.
  static Result<SmoothCurve> through(std::span<const glm::dvec3> points);

  /// Returns the arc length, with a relative error of at most 1e-5.
  double length() const { return lengths_.back(); }
  /// Returns the point at this arc length, clamped to the ends.
  glm::dvec3 at(double length) const;
  /// Returns the unit tangent at this arc length, clamped to the ends.
  glm::dvec3 tangent(double length) const;
  /// Returns the arc length at each of the curve's points.
  std::vector<double> knots() const;
  /// Returns a polyline with `partsAPiece` segments between consecutive points.
  std::vector<glm::dvec3> line(int partsAPiece) const;

 private:
  // A cubic Hermite piece.
  struct Piece {
    glm::dvec3 from, to, fromSlope, toSlope;

    glm::dvec3 at(double t) const;
    glm::dvec3 slope(double t) const;
  };
  struct Place {
    const Piece* piece;
    double t;          // 0 .. 1 within it
    std::size_t part;  // index of the part of lengths_ that holds it
  };

  Place placeOf(double length) const;

  std::vector<Piece> pieces_;
  std::vector<double> lengths_;  // arc length at the part ends of all pieces
};

}  // namespace volumen
