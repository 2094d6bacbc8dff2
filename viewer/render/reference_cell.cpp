#include "viewer/render/reference_cell.h"

#include <glm/common.hpp>

namespace volumen::reference {

namespace {

// Calls visit(n, voxel) for the voxels at the corners of the cell.
template <class Visit>
void eachCorner(const Volume& volume, glm::ivec3 cell, Visit visit) {
  for (int n = 0; n < 8; ++n)
    visit(n, glm::clamp(cell + glm::ivec3(n & 1, (n >> 1) & 1, n >> 2), glm::ivec3(0), volume.size() - 1));
}

template <class Samples>
glm::dvec3 sobel(const Volume& volume, const Samples& samples, glm::ivec3 voxel) {
  static constexpr double derivative[3] = {-0.5, 0, 0.5}, smooth[3] = {0.25, 0.5, 0.25};
  const glm::ivec3 size = volume.size();
  glm::dvec3 sum(0);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const glm::ivec3 at = glm::clamp(voxel + glm::ivec3(i, j, k) - 1, glm::ivec3(0), size - 1);
        const std::size_t n = (std::size_t(at.z) * size.y + at.y) * size.x + at.x;
        sum += double(volume.realValue(samples[n])) * glm::dvec3(derivative[i] * smooth[j] * smooth[k],
                                                                 smooth[i] * derivative[j] * smooth[k],
                                                                 smooth[i] * smooth[j] * derivative[k]);
      }
  return sum;
}

}  // namespace

Corners<double> cornerValues(const Volume& volume, glm::ivec3 cell) {
  Corners<double> corners;
  eachCorner(volume, cell, [&](int n, glm::ivec3 v) { corners[n] = volume.value(v.x, v.y, v.z); });
  return corners;
}

Corners<glm::dvec3> cornerGradients(const Volume& volume, glm::ivec3 cell) {
  Corners<glm::dvec3> corners;
  std::visit(
      [&](const auto& samples) {
        eachCorner(volume, cell, [&](int n, glm::ivec3 v) { corners[n] = sobel(volume, samples, v); });
      },
      volume.stored());
  return corners;
}

}  // namespace volumen::reference
