#pragma once

#include "viewer/plan/options.h"
#include "viewer/tables/reflectance_map.h"

namespace volumen {

/// Returns D' and S' of picture.md 5 at every node, in single precision; at least 2 x 2 nodes.
ReflectanceMap makeReflectanceMap(const Lighting& lighting, int n, MapLookup lookup);

}  // namespace volumen
