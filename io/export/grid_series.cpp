#include "io/export/grid_series.h"

#include <algorithm>
#include <cmath>

namespace volumen {

namespace {

// Returns the slices of the source that slice `k` of a grid shows.
std::vector<int> sourcesOfSlice(const PlacedGrid& grid, int k, const Loaded& loaded) {
  const glm::dvec3 last(grid.geometry.size - 1);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double i : {0.0, last.x})
    for (const double j : {0.0, last.y}) {
      const glm::dvec3 place = grid.volumeFromGrid(grid.geometry.patientFromVoxel({i, j, k}));
      const double at = loaded.drawn->geometry().voxelFromPatient(place).z;
      low = std::min(low, at), high = std::max(high, at);
    }
  return sourcesBetween(loaded, low, high, grid.interpolation);
}

std::string descriptionOf(const SeriesIdentity& series) {
  return series.description.empty() ? "series " + series.seriesUid : series.description;
}

}  // namespace

Result<StackVolume> resampleOnGrid(const Volume& volume, const OtherGrid& grid, const Progress& progress,
                                   const CancelToken& cancel) {
  const VoxelGeometry& to = grid.placed.geometry;
  if (!volume.geometry().calibrated || !to.calibrated)
    return Error{volume.attributes().name + " on the grid of " + descriptionOf(grid.series) +
                 ": one of the two is not calibrated, so that their positions cannot be compared."};
  const auto append = [&](int k, std::vector<float>& values) -> Status {
    const auto slice = resampleGridSlice(volume, grid.placed, k, cancel);
    if (!slice) return slice.error();
    values.insert(values.end(), slice->begin(), slice->end());
    return {};
  };
  return volumeOfSlices(volume, to, append, progress);
}

DicomSeriesTags gridTags(DicomSeriesTags ofSource, const Loaded& loaded, const OtherGrid& grid,
                         int seriesNumber) {
  const std::string other = descriptionOf(grid.series);
  Resampling how;
  how.words = "On the grid of " + other + " (" + grid.series.seriesUid + "), resampled with " +
              wordsOf(grid.placed.interpolation) + " interpolation";
  if (!grid.relation.empty()) how.words += ", " + grid.relation;
  how.code = {"113085", "DCM", "Spatial resampling"};
  how.imageType = "RESAMPLED";
  how.thicknessMm = sliceDistance(grid.placed.geometry);
  how.frameOfReferenceUid = grid.series.frameOfReferenceUid;
  for (int k = 0; k < grid.placed.geometry.size.z; ++k)
    how.sources.push_back(sourcesOfSlice(grid.placed, k, loaded));
  ofSource.description = inOneLine(descriptionOf(ofSource) + " on the grid of " + other);
  ofSource.seriesNumber = std::to_string(seriesNumber);
  ofSource.origins.clear();
  ofSource.resampling = std::move(how);
  return ofSource;
}

}  // namespace volumen
