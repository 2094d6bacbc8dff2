#include "viewer/reference/cell.h"

#include <glm/common.hpp>

namespace volumen::reference {

namespace {

// Returns the memory offsets of the voxels first, first + 1, ... of one axis, with clamped indices
// (picture.md 2).
template <int count>
std::array<std::size_t, count> offsets(int first, int size, std::size_t stride) {
  std::array<std::size_t, count> out;
  for (int n = 0; n < count; ++n) out[n] = std::size_t(glm::clamp(first + n, 0, size - 1)) * stride;
  return out;
}

template <class Samples>
glm::dvec3 sobel(const Volume& volume, const Samples& samples, glm::ivec3 voxel) {
  static constexpr double derivative[3] = {-0.5, 0, 0.5}, smooth[3] = {0.25, 0.5, 0.25};
  const glm::ivec3 size = volume.size();
  const auto x = offsets<3>(voxel.x - 1, size.x, 1), y = offsets<3>(voxel.y - 1, size.y, size.x),
             z = offsets<3>(voxel.z - 1, size.z, std::size_t(size.x) * size.y);
  glm::dvec3 sum(0);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        sum += double(volume.realValue(samples[x[i] + y[j] + z[k]])) *
               glm::dvec3(derivative[i] * smooth[j] * smooth[k], smooth[i] * derivative[j] * smooth[k],
                          smooth[i] * smooth[j] * derivative[k]);
  return sum;
}

}  // namespace

Corners<double> cornerValues(const Volume& volume, glm::ivec3 cell) {
  const glm::ivec3 size = volume.size();
  const auto x = offsets<2>(cell.x, size.x, 1), y = offsets<2>(cell.y, size.y, size.x),
             z = offsets<2>(cell.z, size.z, std::size_t(size.x) * size.y);
  Corners<double> corners;
  std::visit(
      [&](const auto& samples) {
        for (int n = 0; n < 8; ++n)
          corners[n] = volume.realValue(samples[x[n & 1] + y[(n >> 1) & 1] + z[n >> 2]]);
      },
      volume.stored());
  return corners;
}

Corners<glm::dvec3> cornerGradients(const Volume& volume, glm::ivec3 cell) {
  Corners<glm::dvec3> corners;
  std::visit(
      [&](const auto& samples) {
        for (int n = 0; n < 8; ++n) {
          const glm::ivec3 corner = cell + glm::ivec3(n & 1, (n >> 1) & 1, n >> 2);
          corners[n] = sobel(volume, samples, glm::clamp(corner, glm::ivec3(0), volume.size() - 1));
        }
      },
      volume.stored());
  return corners;
}

}  // namespace volumen::reference
