#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// A smooth open curve through points of space, measured by its arc length: cubic pieces from point to point
/// (Catmull and Rom 1974) with centripetal knots, which make neither loops nor cusps within a piece (Yuksel,
/// Schaefer and Keyser, Computer-Aided Design 43 (2011) 747-755). At its ends it runs along the parabola
/// through the three points there; through two points it is straight. Lengths are those of the coordinates,
/// mm in the patient.
class SmoothCurve {
 public:
  /// The curve through these points in their order; points that repeat the one before are left out. An Error
  /// where a coordinate is not finite or above 1e9, or fewer than two points are left.
  static Result<SmoothCurve> through(std::span<const glm::dvec3> points);

  /// Its arc length, within a share of 1e-5.
  double length() const { return lengths_.back(); }
  /// The place so far along it; before the start and behind the end the ends themselves.
  glm::dvec3 at(double length) const;
  /// Its direction there, a unit vector.
  glm::dvec3 tangent(double length) const;
  /// How far along it the points lie that it was made of.
  std::vector<double> knots() const;
  /// A line that looks like it: so many straight parts from point to point.
  std::vector<glm::dvec3> line(int partsAPiece) const;

 private:
  // Of Hermite's cubic.
  struct Piece {
    glm::dvec3 from, to, fromSlope, toSlope;

    glm::dvec3 at(double t) const;
    glm::dvec3 slope(double t) const;
  };
  struct Place {
    const Piece* piece;
    double t;          // 0 .. 1 within it
    std::size_t part;  // of lengths_, that it lies behind
  };

  Place placeOf(double length) const;

  std::vector<Piece> pieces_;
  std::vector<double> lengths_;  // up to the ends of the parts into which each piece is cut
};

}  // namespace volumen
