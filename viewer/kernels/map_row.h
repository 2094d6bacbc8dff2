#pragma once

#include "viewer/tables/lighting.h"

namespace volumen {

/// A row of a reflectance map's face. Node u lies in a direction with three components. Component `axis` is
/// `sign`, the next one (cyclic) sign * (2 u + 1 - n) / span, and the last one sign * v.
struct MapRow {
  int axis = 0;
  float sign = 1, v = 0, span = 1;
  int n = 0;  ///< Number of nodes.
};

/// Computes D' and S' of picture.md 5 at the nodes of a row, laid out as in ReflectanceMap.
using MapRowKernel = void (*)(const Lighting&, const MapRow&, float* nodes);
MapRowKernel chooseMapRowKernel();

}  // namespace volumen
