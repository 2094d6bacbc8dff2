#include "viewer/render/shading/reflectance_map.h"

#include "viewer/render/kernels/map_row.h"
#include "viewer/volume/parallel.h"

namespace volumen {

Lighting mapInputs(Lighting lighting) {
  lighting.flat = glm::vec3(0);
  if (!lighting.twoSided) lighting.viewer = glm::vec3(0);
  if (lighting.specular) return lighting;
  lighting.shininess = 1;
  lighting.wholeShininess = 0;
  for (ShadingLight& light : lighting.lights) light.h = light.specular = glm::vec3(0);
  return lighting;
}

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
