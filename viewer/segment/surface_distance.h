#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/box_tree.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Distances to a surface, exact.
class SurfaceDistance {
 public:
  /// Of a surface that has triangles.
  explicit SurfaceDistance(const Surface& surface);

  /// From p to the nearest point of all triangles, mm. `near`: a triangle to begin with (at first 0), which
  /// becomes the nearest; where points that are asked for one after another lie close together, that is
  /// quick.
  double from(glm::dvec3 p, std::size_t& near) const;

 private:
  using Triangle = std::array<glm::vec3, 3>;
  struct Search;
  void search(Search& search, std::size_t level, std::size_t group) const;

  BoxTree tree_;
  std::vector<Triangle> triangles_;  // in the order of the tree
};

/// Distances (mm) from a surface to another one.
struct SurfaceDistances {
  std::vector<double> ofTriangles;  ///< from the middle of each
  std::vector<double> areas;        ///< of them, mm^2
  double largest = 0;               ///< from all middles and corners
};

/// The same for any number of threads. Where it is cancelled, nothing.
SurfaceDistances distances(const Surface& of, const SurfaceDistance& to, const CancelToken& cancel = {});

/// Two points of a surface that are farthest from each other; it has points.
std::array<glm::vec3, 2> farthestPoints(const Surface& surface);

}  // namespace volumen
