#include "viewer/measure/lengths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace volumen {

namespace {

// Returns the variance of a length that changes by g . d where a point moves by d. The point lies anywhere in
// its voxel and, along g, anywhere in the depth of a soft surface.
double varianceOf(const VoxelGeometry& geometry, glm::dvec3 g, double softMm) {
  const glm::dvec3 spread = glm::transpose(geometry.patientFromVoxelStep) * g;
  return glm::dot(spread, spread) / 12 + glm::dot(g, g) * depthVariance(softMm);
}

}  // namespace

Length lengthOf(std::span<const glm::dvec3> points, const VoxelGeometry& geometry, double softMm) {
  const glm::dvec3 spacing = geometry.spacing();
  const double longest = std::max({spacing.x, spacing.y, spacing.z});
  double sum = 0, variance = 0;
  glm::dvec3 before(0);  // direction of the segment before a point
  for (std::size_t n = 1; n < points.size(); ++n) {
    const glm::dvec3 segment = points[n] - points[n - 1];
    const double mm = glm::length(segment);
    if (mm == 0) {
      variance += 2 * (longest * longest / 12 + depthVariance(softMm));
      continue;
    }
    variance += varianceOf(geometry, before - segment / mm, softMm);
    before = segment / mm;
    sum += mm;
  }
  return {sum, 2 * std::sqrt(variance + varianceOf(geometry, before, softMm))};
}

double depthVariance(double softMm) { return softMm * softMm / 3; }

Result<double> angleBetween(glm::dvec3 a, glm::dvec3 b) {
  if (glm::length(a) == 0 || glm::length(b) == 0)
    return Error{"There is no angle where an arm has no length."};
  // Well-conditioned at 0 and 180 degrees, unlike the arc cosine.
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

Result<double> cobbAngle(glm::dvec3 a, glm::dvec3 b) {
  Result<double> angle = angleBetween(a, b);
  if (angle) *angle = std::min(*angle, 180 - *angle);
  return angle;
}

Result<double> angleOf(std::span<const glm::dvec3> p, bool cobb) {
  return cobb ? cobbAngle(p[1] - p[0], p[3] - p[2]) : angleBetween(p[0] - p[1], p[2] - p[1]);
}

}  // namespace volumen
