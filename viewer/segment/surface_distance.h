#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/segment/box_tree.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The triangles of a surface in a bounding volume hierarchy, for exact distances.
class TriangleTree {
 public:
  using Triangle = std::array<glm::vec3, 3>;

  /// The surface must have triangles.
  explicit TriangleTree(const Surface& surface);

  /// Returns the triangles in tree order: neighbours in the list are mostly close together.
  std::span<const Triangle> triangles() const { return triangles_; }
  /// Returns the distance from p to the nearest triangle in mm. `near` is the triangle to start from (0 at
  /// first) and becomes the nearest one, which makes queries of nearby points fast.
  double distance(glm::dvec3 p, std::size_t& near) const;

 private:
  struct Search;
  void search(Search& search, std::size_t level, std::size_t group) const;

  BoxTree tree_;
  std::vector<Triangle> triangles_;  // triangles in tree order
};

/// Distances from one surface to another, mm.
struct SurfaceDistances {
  std::vector<double> ofTriangles;  ///< Distances from the centre of each triangle, in tree order
  std::vector<double> areas;        ///< Areas of the triangles, mm^2
  double largest = 0;               ///< Over all centres and corners
};

/// Returns the same result for any number of threads, and an empty one if cancelled.
SurfaceDistances distances(const TriangleTree& of, const TriangleTree& to, const CancelToken& cancel = {});

}  // namespace volumen
