#include "io/export/segments_file.h"

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

// Counts labelled voxels with their centre outside a grid.
std::int64_t voxelsOutside(const LabelMap& labels, const VoxelGeometry& grid) {
  const VoxelGeometry& own = labels.geometry();
  std::vector<std::int64_t> counts(std::size_t(own.size.z));
  parallelFor(own.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint8_t> row(std::size_t(own.size.x));
    for (std::int64_t k = begin; k < end; ++k)
      for (int j = 0; j < own.size.y; ++j) {
        labels.readRow(j, int(k), row.data());
        for (int i = 0; i < own.size.x; ++i)
          if (row[std::size_t(i)] != 0 && !isInside(grid, own.patientFromVoxel({i, j, k})))
            ++counts[std::size_t(k)];
      }
  });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

// Counts set pixels of a segmentation with their centre outside a grid.
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

Status noteMoved(SegmentsFile& file, const std::string& from, const std::string& to, const Moved& moved) {
  if (moved.after == 0 && moved.outside == moved.before)
    return Error{"All of its segments lie outside " + to + "."};
  file.notes.push_back("The segments lie on another grid" + from + ": each voxel of " + to +
                       " has what the nearest of them has; " + mlText(moved.before) + " became " +
                       mlText(moved.after) + ".");
  if (moved.outside > 0)
    file.notes.push_back(mlText(moved.outside) + " of the segments lie outside " + to +
                         ", and were left out.");
  return {};
}

}  // namespace

Result<SegmentsFile> onGrid(SegmentsFile file, const VoxelGeometry& grid, const std::string& whose) {
  if (file.maps.empty()) return file;
  const VoxelGeometry own = file.maps.front().labels.geometry();
  if (!own.calibrated || !grid.calibrated) {
    if (own.size != grid.size)
      return Error{"The segments have " + sizeText(own.size) + " voxels and " + whose + " " +
                   sizeText(grid.size) + ", and where they lie is not known."};
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
  if (Status s = noteMoved(file, " (" + sizeText(own.size) + " voxels)", whose, moved); !s) return s.error();
  return file;
}

// If as many voxels as pixels are set, the grid holds each pixel.
Result<SegmentsFile> onGrid(const Segmentation& s, const VoxelGeometry& grid, const CancelToken& cancel,
                            const AcquiredSlices& slices) {
  if (!grid.calibrated) return Error{"Where the series lies is not known: segments have no place in it."};
  SegmentsFile file{segmentedOf(s, grid, cancel, slices), s.notes};
  if (cancel.cancelled()) return Error{"Cancelled."};
  std::int64_t before = 0, after = 0;
  for (std::size_t n = 0; n < s.segments.size(); ++n) before += pixelsOf(s, n);
  for (const Segmented& map : file.maps) after += voxelsMarked(map.labels);
  const double pixel = s.mm.x * s.mm.y * s.thickness;
  if (before == after) return file;
  const Moved moved{double(before) * pixel, double(after) * grid.voxelVolume(),
                    double(pixelsOutside(s, grid)) * pixel};
  if (Status status = noteMoved(file, "", "the series", moved); !status) return status.error();
  return file;
}

}  // namespace volumen
