#include "ui/workspace/clip_box.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace volumen {

namespace {

// Clips the line a . x = e to a rectangle. Returns false if they do not meet.
bool cutRectangle(glm::dvec2 a, double e, glm::dvec2 low, glm::dvec2 high, glm::dvec2& from, glm::dvec2& to) {
  const double square = glm::dot(a, a);
  if (!(square > 0)) return false;
  const glm::dvec2 foot = a * (e / square), along = glm::dvec2(-a.y, a.x) / std::sqrt(square);
  double first = -1e300, last = 1e300;
  for (int n = 0; n < 2; ++n) {
    if (std::abs(along[n]) < 1e-12) {
      if (foot[n] < low[n] || foot[n] > high[n]) return false;
      continue;
    }
    const double t = (low[n] - foot[n]) / along[n], u = (high[n] - foot[n]) / along[n];
    first = std::max(first, std::min(t, u));
    last = std::min(last, std::max(t, u));
  }
  if (!(first < last)) return false;
  from = foot + first * along;
  to = foot + last * along;
  return true;
}

}  // namespace

std::vector<ClipEdge> clipEdges(const Clip& clip, const VoxelGeometry& geometry, const SlicePlane& plane) {
  // Plane and box in voxel space.
  const glm::dvec3 a = glm::transpose(geometry.patientFromVoxelStep) * plane.normal(), n(geometry.size);
  const double d = glm::dot(plane.normal(), plane.centre - geometry.origin);
  const glm::dvec3 ends[] = {clip.boxLow * n - 0.5, clip.boxHigh * n - 0.5};
  std::vector<ClipEdge> edges;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      const double face = ends[high][axis];
      glm::dvec2 from, to;
      if (!cutRectangle({a[i], a[j]}, d - a[axis] * face, {ends[0][i], ends[0][j]}, {ends[1][i], ends[1][j]},
                        from, to))
        continue;
      ClipEdge edge{axis, high, {}, {}};
      for (const auto& [place, end] : {std::pair(&edge.from, from), std::pair(&edge.to, to)}) {
        glm::dvec3 x;
        x[axis] = face, x[i] = end.x, x[j] = end.y;
        *place = geometry.patientFromVoxel(x);
      }
      edges.push_back(edge);
    }
  return edges;
}

void moveClipFace(Clip& clip, int axis, bool high, double fraction) {
  const double to = std::clamp(fraction, 0.0, 1.0);
  double &low = clip.boxLow[axis], &top = clip.boxHigh[axis];
  (high ? top : low) = to;
  if (low > top) (high ? low : top) = to;
}

}  // namespace volumen
