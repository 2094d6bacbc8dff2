#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/segment/box_tree.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The triangles of a surface, those near each other together, and distances to them, exact.
class TriangleTree {
 public:
  using Triangle = std::array<glm::vec3, 3>;

  /// Of a surface that has triangles.
  explicit TriangleTree(const Surface& surface);

  /// In an order in which those beside each other are mostly near each other.
  std::span<const Triangle> triangles() const { return triangles_; }
  /// From p to the nearest point of all triangles, mm. `near`: a triangle to begin with (at first 0), which
  /// becomes the nearest: quick for points near each other, asked for one after another.
  double distance(glm::dvec3 p, std::size_t& near) const;

 private:
  struct Search;
  void search(Search& search, std::size_t level, std::size_t group) const;

  BoxTree tree_;
  std::vector<Triangle> triangles_;  // in the order of the tree
};

/// Distances (mm) from a surface to another one.
struct SurfaceDistances {
  std::vector<double> ofTriangles;  ///< from the middle of each, in the order of its tree
  std::vector<double> areas;        ///< of them, mm^2
  double largest = 0;               ///< from all middles and corners
};

/// The same for any number of threads. Where it is cancelled, nothing.
SurfaceDistances distances(const TriangleTree& of, const TriangleTree& to, const CancelToken& cancel = {});

}  // namespace volumen
