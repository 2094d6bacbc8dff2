#pragma once

#include <vector>

#include "viewer/tables/lighting.h"

namespace volumen {

/// The shades of all directions on the six faces of a cube (paper 2.2). Directions are on face 2a +
/// (component a < 0), where a is the normal's largest component. u, v are the next two components (cyclic)
/// divided by it, -1 .. 1. Bilinear: n x n nodes from edge to edge. Nearest: the middles of n x n equal
/// patches, as in the paper.
struct ReflectanceMap {
  int n = 0;
  bool coloured = true;  ///< True: a node is D and S of red, of green, of blue, and 0, 0. False: one D and S.
  std::vector<float> nodes;  ///< Index ((face * n + v) * n + u) * floatsANode(coloured).
  static constexpr int floatsANode(bool coloured) { return coloured ? 8 : 2; }
};

/// Returns the parts of a lighting on which its maps depend, with the rest set to fixed values. The viewer's
/// direction matters only for two sides and for highlights.
Lighting mapInputs(Lighting lighting);

}  // namespace volumen
