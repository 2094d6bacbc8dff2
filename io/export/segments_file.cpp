#include "io/export/segments_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "viewer/segment/labels_on.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

std::string sizeText(glm::ivec3 size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

std::string mlText(double mm3) {
  char text[32];
  std::snprintf(text, sizeof text, mm3 < 1e5 ? "%.3g ml" : "%.0f ml", mm3 / 1000);
  return text;
}

bool isInside(const VoxelGeometry& grid, glm::dvec3 pPatient) {
  const glm::dvec3 at = grid.voxelFromPatient(pPatient) + 0.5;
  return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < grid.size.x && at.y < grid.size.y &&
         at.z < grid.size.z;
}

std::int64_t voxelsMarked(const LabelMap& labels) {
  return labels.geometry().voxelCount() - labelCounts(labels)[0];
}

// Returns for each slice the number of labelled voxels for which counts(voxel) is true.
template <class Counts>
std::vector<std::int64_t> voxelsBySlice(const LabelMap& labels, const Counts& counts) {
  const glm::ivec3 size = labels.geometry().size;
  std::vector<std::int64_t> all(std::size_t(size.z));
  parallelFor(size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint8_t> row(std::size_t(size.x));
    for (std::int64_t k = begin; k < end; ++k)
      for (int j = 0; j < size.y; ++j) {
        labels.readRow(j, int(k), row.data());
        for (int i = 0; i < size.x; ++i)
          if (row[std::size_t(i)] != 0 && counts(glm::ivec3(i, j, k))) ++all[std::size_t(k)];
      }
  });
  return all;
}

// Returns the number of labelled voxels with their centre outside a grid.
std::int64_t voxelsOutside(const LabelMap& labels, const VoxelGeometry& grid) {
  const VoxelGeometry& own = labels.geometry();
  const auto counts =
      voxelsBySlice(labels, [&](glm::ivec3 voxel) { return !isInside(grid, own.patientFromVoxel(voxel)); });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

// Returns the volume of labels on acquired slices, in mm^3.
double mm3OnSlices(const LabelMap& onSlices, const std::vector<double>& places, const VoxelGeometry& grid) {
  const auto counts = voxelsBySlice(onSlices, [](glm::ivec3) { return true; });
  const std::vector<double> shares = sharesOf(places);
  return grid.voxelVolume() * std::inner_product(counts.begin(), counts.end(), shares.begin(), 0.0);
}

// Returns the number of set pixels of a segmentation with their centre outside a grid.
std::int64_t pixelsOutside(const Segmentation& s, const VoxelGeometry& grid) {
  std::vector<std::int64_t> counts(s.frames.size());
  parallelFor(std::int64_t(s.frames.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n)
      for (int y = 0; y < s.size.y; ++y)
        for (int x = 0; x < s.size.x; ++x) {
          if (!s.isSet(std::size_t(n), x, y)) continue;
          const glm::dvec3 centre =
              s.frames[std::size_t(n)].origin + x * s.mm.x * s.right + y * s.mm.y * s.down;
          if (!isInside(grid, centre)) ++counts[std::size_t(n)];
        }
  });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

// Volumes of segments before and after resampling to another grid, in mm^3.
struct Moved {
  double before = 0;   // volume in the file
  double after = 0;    // volume in the series
  double outside = 0;  // volume in the file that lies outside the series
};

// Adds notes about a change of volume. `how` describes the resampling and may be empty. Returns an Error if
// all segments lie outside.
Status noteMoved(SegmentsFile& file, const std::string& how, const std::string& whose, const Moved& moved) {
  if (moved.after == 0 && moved.outside >= moved.before)
    return Error{"All of its segments lie outside " + whose + "."};
  if (!how.empty())
    file.notes.push_back(how + "; " + mlText(moved.before) + " became " + mlText(moved.after) + ".");
  if (moved.outside > 0)
    file.notes.push_back(mlText(moved.outside) + " of the segments lie outside " + whose +
                         ", and were left out.");
  return {};
}

std::string toNearest(const std::string& from, const std::string& whose) {
  return "The segments lie on another grid" + from + ": each voxel of " + whose +
         " has what the nearest of them has";
}

}  // namespace

Result<SegmentsFile> onGrid(SegmentsFile file, const VoxelGeometry& grid, const std::string& whose) {
  if (file.maps.empty()) return file;
  const VoxelGeometry own = file.maps.front().labels.geometry();
  if (!own.calibrated || !grid.calibrated) {
    if (own.size != grid.size)
      return Error{"The segments have " + sizeText(own.size) + " voxels and " + whose + " " +
                   sizeText(grid.size) + ", and their positions are not known."};
    for (Segmented& map : file.maps) {
      DenseLabels labels = map.labels.dense();
      labels.geometry = grid;
      map.labels = LabelMap(labels);
    }
    return file;
  }
  const bool isSame = areSameVoxels(own, grid);
  std::int64_t before = 0, after = 0, outside = 0;
  for (Segmented& map : file.maps) {
    if (!isSame) before += voxelsMarked(map.labels), outside += voxelsOutside(map.labels, grid);
    map.labels = labelsOn(map.labels, grid);
    if (!isSame) after += voxelsMarked(map.labels);
  }
  if (before == 0) return file;
  const Moved moved{double(before) * own.voxelVolume(), double(after) * grid.voxelVolume(),
                    double(outside) * own.voxelVolume()};
  const std::string how = toNearest(" (" + sizeText(own.size) + " voxels)", whose);
  if (Status s = noteMoved(file, how, whose, moved); !s) return s.error();
  return file;
}

namespace {

// Adds notes about the change of volume when each grid slice takes the labels of the nearest acquired slice.
Status noteSpread(SegmentsFile& file, double outside, const AcquiredSlices& slices,
                  const VoxelGeometry& grid) {
  constexpr double unchanged = 0.005;
  Moved moved{0, 0, outside};
  for (const Segmented& map : file.maps) {
    moved.before += mm3OnSlices(map.acquired->labels, slices.places, grid);
    moved.after += double(voxelsMarked(map.labels)) * grid.voxelVolume();
  }
  const bool isSame = std::abs(moved.after - moved.before) <= unchanged * moved.before;
  return noteMoved(file,
                   isSame ? ""
                          : "The segments lie on the acquired slices: each slice of the even grid takes the "
                            "nearest one",
                   "the series", moved);
}

}  // namespace

Result<SegmentsFile> onGrid(const Segmentation& s, const VoxelGeometry& grid, const CancelToken& cancel,
                            const AcquiredSlices& slices) {
  if (!grid.calibrated)
    return Error{"The position of the series is not known, so segments cannot be placed in it."};
  SegmentsFile file{segmentedOf(s, grid, cancel, slices), s.notes};
  if (cancel.cancelled()) return Error{"Cancelled."};
  const double pixel = s.mm.x * s.mm.y * s.thickness;
  const auto isOnSlices = [](const Segmented& map) { return map.acquired != nullptr; };
  if (!file.maps.empty() && std::ranges::all_of(file.maps, isOnSlices)) {
    if (Status status = noteSpread(file, double(pixelsOutside(s, grid)) * pixel, slices, grid); !status)
      return status.error();
    return file;
  }
  std::int64_t before = 0, after = 0;
  for (std::size_t n = 0; n < s.segments.size(); ++n) before += pixelsOf(s, n);
  for (const Segmented& map : file.maps) after += voxelsMarked(map.labels);
  if (before == after) return file;  // each pixel has its own voxel
  const Moved moved{double(before) * pixel, double(after) * grid.voxelVolume(),
                    double(pixelsOutside(s, grid)) * pixel};
  if (Status status = noteMoved(file, toNearest("", "the series"), "the series", moved); !status)
    return status.error();
  return file;
}

}  // namespace volumen
