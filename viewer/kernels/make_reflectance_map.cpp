#include "viewer/kernels/make_reflectance_map.h"

#include "viewer/kernels/map_row.h"
#include "viewer/volume/parallel.h"

namespace volumen {

ReflectanceMap makeReflectanceMap(const Lighting& lighting, int n, MapLookup lookup) {
  const int floats = ReflectanceMap::floatsANode(lighting.coloured);
  ReflectanceMap map{n, lighting.coloured, std::vector<float>(std::size_t(6) * n * n * floats, 0.0f)};
  const MapRowKernel shadeRow = chooseMapRowKernel();
  const float span = float(lookup == MapLookup::nearest ? n : n - 1);
  parallelFor(std::int64_t(6) * n, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const int face = int(row / n), v = int(row % n);
      const MapRow nodes{face / 2, face % 2 ? -1.0f : 1.0f, float(2 * v + 1 - n) / span, span, n};
      shadeRow(lighting, nodes, &map.nodes[std::size_t(row) * n * floats]);
    }
  });
  return map;
}

}  // namespace volumen
