#include "viewer/render/shading/reflectance_map.h"

#include <glm/geometric.hpp>

#include "viewer/volume/parallel.h"

namespace volumen {

ReflectanceMap makeReflectanceMap(const Lighting& lighting, int n, MapLookup lookup) {
  ReflectanceMap map{n, std::vector<float>(std::size_t(6) * n * n * ReflectanceMap::stride, 0.0f)};
  const auto place = [&](std::int64_t node) {
    return lookup == MapLookup::nearest ? (2.0 * double(node) + 1) / n - 1 : 2.0 * double(node) / (n - 1) - 1;
  };
  parallelFor(std::int64_t(6) * n, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const int face = int(row / n), axis = face / 2;
      for (int u = 0; u < n; ++u) {
        glm::dvec3 normal;
        const double sign = face % 2 ? -1 : 1;
        normal[axis] = sign;
        normal[(axis + 1) % 3] = sign * place(u);
        normal[(axis + 2) % 3] = sign * place(row % n);
        const Shade shade = shadeOf(lighting, glm::normalize(normal));
        float* node = &map.nodes[(std::size_t(row) * n + u) * ReflectanceMap::stride];
        for (int c = 0; c < 3; ++c) node[c] = float(shade.d[c]), node[3 + c] = float(shade.s[c]);
      }
    }
  });
  return map;
}

}  // namespace volumen
