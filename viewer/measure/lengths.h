#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "viewer/volume/volume.h"

namespace volumen {

/// A length and how far it may be off, mm.
struct Length {
  double mm = 0;
  double plusMinus = 0;  ///< 2 u (slices.md 4)
};

/// The length of a line through patient points. u^2 sums (s^2 + s^2)/12 over the segments, one term for each
/// end. s^2 is the sum of (L_a . d)^2 over the edges L_a of a voxel, d the segment's direction: 12 times the
/// variance along d of an end that lies anywhere in its voxel. s is the longest spacing where the segment
/// has no length and so no direction. `softMm` (Shape::softMm) adds depthVariance() to each term, whatever
/// way the line of sight went.
Length lengthOf(std::span<const glm::dvec3> points, const VoxelGeometry& geometry, double softMm = 0);

/// The variance, mm^2, of a place that is as likely anywhere in a stretch whose middle half is `softMm` long:
/// (2 softMm)^2 / 12.
double depthVariance(double softMm);

/// The angle between two directions of any length, 0 to 180 degrees. None (an Error) where one has no length.
Result<double> angleBetween(glm::dvec3 a, glm::dvec3 b);

/// Cobb's: the smaller angle between two lines, 0 to 90 degrees; likewise.
Result<double> cobbAngle(glm::dvec3 a, glm::dvec3 b);

/// The angle of a shape of these points (ShapeRule), Cobb's or between arms; likewise.
Result<double> angleOf(std::span<const glm::dvec3> points, bool cobb);

}  // namespace volumen
