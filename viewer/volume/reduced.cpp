#include "viewer/volume/reduced.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

template <class T>
T stored(double mean) {
  if constexpr (std::is_same_v<T, float>)
    return float(mean);
  else
    return T(std::lround(mean));
}

// The sum over a cube. Two of them: without padding, and of padding alone.
struct Sum {
  double values = 0, padding = 0;
  std::int64_t count = 0, padded = 0;
  double mean() const { return count > 0 ? values / double(count) : padding / double(padded); }
};

template <class T>
T meanOf(const std::vector<T>& from, const Volume& volume, glm::ivec3 low, int factor) {
  const glm::ivec3 size = volume.size(), high = glm::min(low + factor, size);
  const std::optional<ValueRange>& padding = volume.attributes().padding;
  Sum sum;
  for (int k = low.z; k < high.z; ++k)
    for (int j = low.y; j < high.y; ++j) {
      const T* row = from.data() + (std::size_t(k) * size.y + j) * std::size_t(size.x);
      for (int i = low.x; i < high.x; ++i)
        if (padding && isPadding(padding, volume.realValue(row[i])))
          sum.padding += row[i], ++sum.padded;
        else
          sum.values += row[i], ++sum.count;
    }
  return stored<T>(sum.mean());
}

}  // namespace

VoxelGeometry reducedGeometry(const VoxelGeometry& geometry, int factor) {
  VoxelGeometry reduced = geometry;
  reduced.size = (geometry.size + (factor - 1)) / factor;
  reduced.patientFromVoxelStep *= double(factor);
  reduced.origin = geometry.patientFromVoxel(glm::dvec3((factor - 1) / 2.0));
  return reduced;
}

VolumePtr reducedVolume(const Volume& volume, int factor) {
  VolumeParts parts{reducedGeometry(volume.geometry(), factor),
                    {},
                    volume.slope(),
                    volume.intercept(),
                    volume.attributes()};
  const glm::ivec3 size = parts.geometry.size;
  std::visit(
      [&]<class T>(const std::vector<T>& from) {
        std::vector<T> to = zeros<T>(std::size_t(parts.geometry.voxelCount()));
        parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
          for (std::int64_t row = begin; row < end; ++row)
            for (int i = 0; i < size.x; ++i)
              to[std::size_t(row * size.x + i)] =
                  meanOf(from, volume, glm::ivec3(i, row % size.y, row / size.y) * factor, factor);
        });
        parts.values = std::move(to);
      },
      volume.stored());
  std::vector<std::string> unchanged;
  return *Volume::make(std::move(parts), unchanged);
}

}  // namespace volumen
