#include "viewer/slice/smooth_curve.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

using glm::dvec3;

constexpr int partsOfPiece = 256;
constexpr double largestCoordinate = 1e9, samePlace = 1e-6;

bool isPlace(dvec3 p) {
  return std::abs(p.x) <= largestCoordinate && std::abs(p.y) <= largestCoordinate &&
         std::abs(p.z) <= largestCoordinate;
}

// Returns the end slope of the parabola through three points; h0 and h1 are the knot intervals.
dvec3 slopeAtEnd(dvec3 first, dvec3 second, double h0, double h1) {
  return first + (first - second) * (h0 / (h0 + h1));
}

}  // namespace

dvec3 SmoothCurve::Piece::at(double t) const {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * from + (t3 - 2 * t2 + t) * fromSlope + (3 * t2 - 2 * t3) * to +
         (t3 - t2) * toSlope;
}

dvec3 SmoothCurve::Piece::slope(double t) const {
  const double t2 = t * t;
  return (6 * t2 - 6 * t) * (from - to) + (3 * t2 - 4 * t + 1) * fromSlope + (3 * t2 - 2 * t) * toSlope;
}

Result<SmoothCurve> SmoothCurve::through(std::span<const dvec3> points) {
  std::vector<dvec3> p;
  for (const dvec3 point : points) {
    if (!isPlace(point)) return Error{"A point of the curve is not a place within 1e9 mm."};
    if (p.empty() || glm::distance(p.back(), point) > samePlace) p.push_back(point);
  }
  if (p.size() < 2) return Error{"A curve needs points at two different places: set another one."};
  const std::size_t last = p.size() - 1;
  std::vector<double> knots;  // intervals from each point to the next
  std::vector<dvec3> slopes, chords;
  for (std::size_t n = 0; n < last; ++n) {
    knots.push_back(std::sqrt(glm::distance(p[n], p[n + 1])));
    chords.push_back((p[n + 1] - p[n]) / knots[n]);
  }
  for (std::size_t n = 0; n <= last; ++n) {
    if (last == 1)
      slopes.push_back(chords[0]);
    else if (n == 0)
      slopes.push_back(slopeAtEnd(chords[0], chords[1], knots[0], knots[1]));
    else if (n == last)
      slopes.push_back(slopeAtEnd(chords[n - 1], chords[n - 2], knots[n - 1], knots[n - 2]));
    else
      slopes.push_back((chords[n - 1] * knots[n] + chords[n] * knots[n - 1]) / (knots[n - 1] + knots[n]));
  }
  SmoothCurve curve;
  curve.lengths_.push_back(0);
  for (std::size_t n = 0; n < last; ++n) {
    const Piece piece{p[n], p[n + 1], slopes[n] * knots[n], slopes[n + 1] * knots[n]};
    dvec3 before = piece.from;
    for (int part = 1; part <= partsOfPiece; ++part) {
      const dvec3 now = piece.at(double(part) / partsOfPiece);
      curve.lengths_.push_back(curve.lengths_.back() + glm::distance(before, now));
      before = now;
    }
    curve.pieces_.push_back(piece);
  }
  return curve;
}

SmoothCurve::Place SmoothCurve::placeOf(double length) const {
  const auto behind = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, length);
  const std::size_t part = std::size_t(behind - lengths_.begin()) - 1;
  const double width = lengths_[part + 1] - lengths_[part];
  const double share = width > 0 ? std::clamp((length - lengths_[part]) / width, 0.0, 1.0) : 0;
  return {&pieces_[part / partsOfPiece], (double(part % partsOfPiece) + share) / partsOfPiece, part};
}

dvec3 SmoothCurve::at(double length) const {
  const Place place = placeOf(length);
  return place.piece->at(place.t);
}

dvec3 SmoothCurve::tangent(double length) const {
  const Place place = placeOf(length);
  const dvec3 slope = place.piece->slope(place.t);
  if (glm::length(slope) > 0) return glm::normalize(slope);
  // The curve turns back on itself here.
  const double t = double(place.part % partsOfPiece) / partsOfPiece;
  const dvec3 chord = place.piece->at(t + 1.0 / partsOfPiece) - place.piece->at(t);
  return glm::length(chord) > 0 ? glm::normalize(chord) : glm::normalize(place.piece->to - place.piece->from);
}

std::vector<double> SmoothCurve::knots() const {
  std::vector<double> knots;
  for (std::size_t n = 0; n <= pieces_.size(); ++n) knots.push_back(lengths_[n * partsOfPiece]);
  return knots;
}

std::vector<dvec3> SmoothCurve::line(int partsAPiece) const {
  std::vector<dvec3> line{pieces_.front().from};
  for (const Piece& piece : pieces_)
    for (int part = 1; part <= partsAPiece; ++part) line.push_back(piece.at(double(part) / partsAPiece));
  return line;
}

}  // namespace volumen
