#pragma once

#include "results/series/loaded_series.h"

namespace volumen::tests {

/// Returns a bright ball of value 1000 in air of 0. It has `n` voxels of `spacing` mm along each axis,
/// centred on the origin. The ball has `radius` mm about `centre`.
inline LoadedSeriesPtr ballSeries(int n = 32, double radius = 10, glm::dvec3 centre = {0, 0, 0},
                                  glm::dvec3 spacing = {1, 1, 1}) {
  VolumeParts parts;
  parts.geometry.size = {n, n, n};
  for (int axis = 0; axis < 3; ++axis) parts.geometry.patientFromVoxelStep[axis] *= spacing[axis];
  parts.geometry.origin = -(n - 1) / 2.0 * spacing;
  std::vector<std::int16_t> values;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const glm::dvec3 p = parts.geometry.patientFromVoxel({i, j, k}) - centre;
        values.push_back(p.x * p.x + p.y * p.y + p.z * p.z < radius * radius ? 1000 : 0);
      }
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  auto series = std::make_shared<LoadedSeries>();
  series->volume = *Volume::make(std::move(parts), warnings);
  static int made = 0;  // makes each a separate series
  series->series.path = "ball";
  series->series.id = "ball#" + std::to_string(++made);
  series->series.patientName = "Test^Ball";
  series->series.patientId = "42";
  series->series.format = "DICOM";
  series->series.modality = "CT";
  series->series.unit = "HU";
  series->series.description = "Ball";
  series->series.acquired = series->volume->geometry();
  series->histogram = {.low = 0, .high = 1000, .counts = std::vector<std::int64_t>(100, 5)};
  series->firstScene.transferFunction.points = {{400, {1, 1, 1}, 0.0}, {600, {1, 1, 1}, 1.0}};
  return series;
}

/// Returns a separate series with these voxels.
inline LoadedSeriesPtr seriesOf(VolumePtr volume) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(2, 1));
  series->volume = std::move(volume);
  return series;
}

}  // namespace volumen::tests
