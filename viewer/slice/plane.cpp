#include "viewer/slice/plane.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace volumen {

namespace {

constexpr double parallelWithin = 1e-3;

bool isFinite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double smallestSpacing(const VoxelGeometry& geometry) {
  const glm::dvec3 s = geometry.spacing();
  return std::min({s.x, s.y, s.z});
}

// Rounds up, tolerating rounding errors of whole numbers.
double roundedUp(double ratio) { return std::ceil(ratio - 1e-6); }

int largestComponent(glm::dvec3 v) {
  const glm::dvec3 a = glm::abs(v);
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

bool parallelToSlices(const VoxelGeometry& geometry, glm::dvec3 normal) {
  return glm::length(glm::cross(normal, sliceNormal(geometry))) <= parallelWithin;
}

}  // namespace

glm::dvec3 SlicePlane::normal() const { return glm::cross(right, down); }

glm::dvec3 SlicePlane::patientFromPixel(glm::dvec2 pPixel) const {
  const glm::dvec2 mm = (pPixel - glm::dvec2(size) * 0.5) * mmPerPixel;
  return centre + mm.x * right + mm.y * down;
}

glm::dvec2 SlicePlane::pixelFromPatient(glm::dvec3 pPatient) const {
  const glm::dvec3 from = pPatient - centre;
  return glm::dvec2(glm::dot(from, right), glm::dot(from, down)) / mmPerPixel + glm::dvec2(size) * 0.5;
}

Status checkPlane(const SlicePlane& plane) {
  constexpr double within = 1e-6;
  constexpr std::int64_t mostPixels = std::int64_t(1) << 28;
  if (!isFinite(plane.centre)) return Error{"The centre of the plane is not finite."};
  if (!isFinite(plane.right) || !isFinite(plane.down) || std::abs(glm::length(plane.right) - 1) > within ||
      std::abs(glm::length(plane.down) - 1) > within || std::abs(glm::dot(plane.right, plane.down)) > within)
    return Error{"The plane's directions right and down are no orthogonal unit vectors."};
  if (!std::isfinite(plane.mmPerPixel) || plane.mmPerPixel <= 0)
    return Error{"The plane's pixels must have a size above 0 mm."};
  if (!std::isfinite(plane.slabMm) || plane.slabMm < 0)
    return Error{"The thickness of the slab must be 0 mm or more."};
  if (plane.size.x < 1 || plane.size.y < 1 ||
      std::int64_t(plane.size.x) * std::int64_t(plane.size.y) > mostPixels)
    return Error{"A plane of " + std::to_string(plane.size.x) + " x " + std::to_string(plane.size.y) +
                 " pixels cannot be drawn; it may have 1 to " + std::to_string(mostPixels) + " pixels."};
  return {};
}

SlicePlane namedPlane(const VoxelGeometry& geometry, NamedPlane name) {
  const bool sagittal = name == NamedPlane::sagittal, axial = name == NamedPlane::axial;
  return planeAlong(geometry, sagittal ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0),
                    axial ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1));
}

SlicePlane planeAlong(const VoxelGeometry& geometry, glm::dvec3 right, glm::dvec3 down) {
  SlicePlane plane;
  plane.centre = geometry.centre();
  plane.right = right;
  plane.down = down;
  plane.mmPerPixel = smallestSpacing(geometry);
  plane.size = sizeToCover(geometry, plane);
  return plane;
}

glm::ivec2 sizeToCover(const VoxelGeometry& geometry, const SlicePlane& plane) {
  glm::dvec2 half(0);
  for (const glm::dvec3& corner : geometry.boxCorners()) {
    const glm::dvec3 offset = corner - plane.centre;
    half = glm::max(half, glm::abs(glm::dvec2(glm::dot(offset, plane.right), glm::dot(offset, plane.down))));
  }
  const auto pixels = [&](double mm) {
    return int(std::clamp(roundedUp(2 * mm / plane.mmPerPixel), 1.0, double(1 << 30)));
  };
  return {pixels(half.x), pixels(half.y)};
}

double voxelAlong(const VoxelGeometry& geometry, glm::dvec3 normal) {
  return 1 / glm::length(geometry.voxelFromPatientStep() * normal);
}

std::int64_t slabSamples(const SlicePlane& plane, const VoxelGeometry& geometry) {
  const double h = voxelAlong(geometry, plane.normal());
  return std::int64_t(std::clamp(roundedUp(2 * plane.slabMm / h), 1.0, 0x1p60));
}

std::int64_t subSamples(const SlicePlane& plane, const VoxelGeometry& geometry) {
  if (!plane.average) return 1;
  return std::int64_t(std::clamp(roundedUp(plane.mmPerPixel / smallestSpacing(geometry)), 1.0, 0x1p30));
}

glm::dvec3 sliceNormal(const VoxelGeometry& geometry) {
  const auto& L = geometry.patientFromVoxelStep;
  return glm::normalize(glm::cross(L[0], L[1]));
}

double sliceDistance(const VoxelGeometry& geometry) {
  return std::abs(glm::dot(geometry.patientFromVoxelStep[2], sliceNormal(geometry)));
}

double wheelStep(const VoxelGeometry& geometry, glm::dvec3 normal) {
  const auto& L = geometry.patientFromVoxelStep;
  const glm::dvec3 projected = glm::abs(normal * L);
  return projected[largestComponent(projected / geometry.spacing())];
}

std::optional<SlicePlane> onSlice(SlicePlane plane, const VoxelGeometry& geometry, double index) {
  const glm::dvec3 normal = plane.normal();
  if (!parallelToSlices(geometry, normal)) return {};
  const glm::dvec3 centre = (glm::dvec3(geometry.size) - 1.0) * 0.5;
  const glm::dvec3 onIt = geometry.patientFromVoxel({centre.x, centre.y, index});
  plane.centre += normal * glm::dot(normal, onIt - plane.centre);
  return plane;
}

}  // namespace volumen
