#include "viewer/slice/grid_values.h"

#include <algorithm>
#include <limits>

#include "viewer/slice/sample_line.h"
#include "viewer/volume/parallel.h"

namespace volumen {

Result<std::vector<float>> resampleGridSlice(const Volume& volume, const PlacedGrid& grid, int k,
                                             const CancelToken& cancel) {
  const VoxelGeometry &to = grid.geometry, &from = volume.geometry();
  const LineKernel kernel = chooseKernel(volume, grid.interpolation);
  const void* stored =
      std::visit([](const auto& v) { return static_cast<const void*>(v.data()); }, volume.stored());
  const glm::dvec3 step =
      from.voxelFromPatientStep() * (grid.volumeFromGrid.rotation * to.patientFromVoxelStep[0]);
  const auto width = std::size_t(to.size.x);
  std::vector<float> values(width * std::size_t(to.size.y), std::numeric_limits<float>::quiet_NaN());
  parallelFor(to.size.y, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> samples(width + lineSlack);
    for (std::int64_t j = begin; j < end && !cancel.cancelled(); ++j) {
      const glm::dvec3 place = grid.volumeFromGrid(to.patientFromVoxel(glm::dvec3(0, double(j), k)));
      const SampleLine line{from.voxelFromPatient(place), step};
      const SampleRange inside = insideBox(line, {0, to.size.x}, volume.size());
      if (inside.first == inside.last) continue;
      kernel(stored, volume.size(), line, inside, samples.data());
      std::transform(samples.begin(), samples.begin() + (inside.last - inside.first),
                     values.begin() + j * to.size.x + inside.first,
                     [&](float sample) { return volume.realValue(double(sample)); });
    }
  });
  if (cancel.cancelled()) return Error{"cancelled"};
  return values;
}

}  // namespace volumen
