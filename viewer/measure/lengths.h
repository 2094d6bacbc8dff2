#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "viewer/volume/volume.h"

namespace volumen {

/// A length and its uncertainty, in mm.
struct Length {
  double mm = 0;
  double plusMinus = 0;  ///< Twice the standard uncertainty: 2 u (slices.md 4).
};

/// Returns the length of a line through patient points. Its u^2 is the sum of s^2/12 over the points. Here
/// s^2 is the sum of (L_a . g)^2 over the edges L_a of a voxel. At an end g is the direction of its segment,
/// at a corner the difference of the directions before and after it: a point of a straight line changes no
/// length, one where the line turns back counts twice. This is the variance for points anywhere in their
/// voxels. A segment without length adds 2 s^2/12 with the longest spacing. `softMm` (Shape::softMm) adds g^2
/// depthVariance() to each term, whatever the line of sight was.
Length lengthOf(std::span<const glm::dvec3> points, const VoxelGeometry& geometry, double softMm = 0);

/// Returns the variance, mm^2, of a position uniformly distributed over a stretch whose middle half is
/// `softMm` long: (2 softMm)^2 / 12.
double depthVariance(double softMm);

/// Returns the angle between two directions of any length, 0 to 180 degrees. Returns an Error if one has no
/// length.
Result<double> angleBetween(glm::dvec3 a, glm::dvec3 b);

/// Returns Cobb's angle: the smaller angle between two lines, 0 to 90 degrees. Errors as for angleBetween().
Result<double> cobbAngle(glm::dvec3 a, glm::dvec3 b);

/// Returns the angle of a shape with these points (ShapeRule), Cobb's or between arms. Errors as for
/// angleBetween().
Result<double> angleOf(std::span<const glm::dvec3> points, bool cobb);

}  // namespace volumen
