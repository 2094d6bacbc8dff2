#include "viewer/slice/cross_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/slice/curved_volume.h"

namespace volumen {

namespace {

using Section = CurvedGrid::Section;

// Where the first plane is seen from, and what is on top.
struct Facing {
  double side = 1;  // -1: against the curve
  glm::dvec3 down;
};

Facing facingOf(glm::dvec3 along) {
  SlicePlane nearest;
  double most = -1;
  for (const NamedPlane name : {NamedPlane::axial, NamedPlane::coronal, NamedPlane::sagittal}) {
    const SlicePlane plane = namedPlane(VoxelGeometry(), name);
    const double is = std::abs(glm::dot(plane.normal(), along));
    if (is > most) most = is, nearest = plane;
  }
  return {glm::dot(nearest.normal(), along) < 0 ? -1.0 : 1.0,
          glm::normalize(nearest.down - glm::dot(nearest.down, along) * along)};
}

Section sectionAt(const SmoothCurve& curve, double mm) {
  return {curve.at(mm), {}, {}, curve.tangent(mm), mm};
}

}  // namespace

std::vector<SlicePlane> planesAcross(const SmoothCurve& curve, const SlicePlane& like, double distanceMm) {
  constexpr double stepMm = 0.5;  // short beside the bends of vessels and jaws
  const int steps = std::max(1, int(std::ceil(distanceMm / stepMm)));
  const int count = int(std::floor(curve.length() / distanceMm + 1e-6)) + 1;
  Section section = sectionAt(curve, 0);
  const Facing facing = facingOf(section.along);
  glm::dvec3 down = facing.down;
  std::vector<SlicePlane> planes;
  for (int n = 0; n < count; ++n) {
    SlicePlane plane = like;
    plane.centre = section.at;
    plane.down = down;
    plane.right = glm::cross(down, facing.side * section.along);
    planes.push_back(plane);
    for (int step = 1; step <= steps && n + 1 < count; ++step) {
      const Section next = sectionAt(curve, distanceMm * (n + double(step) / steps));
      down = carriedAcross(down, section, next);
      section = next;
    }
  }
  return planes;
}

}  // namespace volumen
