#include "io/export/segments_file.h"

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/labels_on.h"

namespace volumen {

namespace {

std::string sizeText(glm::ivec3 size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

bool liesIn(const VoxelBox& box, const VoxelGeometry& own, const VoxelGeometry& grid) {
  for (const int x : {box.low.x, box.high.x})
    for (const int y : {box.low.y, box.high.y})
      for (const int z : {box.low.z, box.high.z}) {
        const glm::dvec3 at = grid.voxelFromPatient(own.patientFromVoxel({x, y, z})) + 0.5;
        for (int a = 0; a < 3; ++a)
          if (!(at[a] >= 0 && at[a] < grid.size[a])) return false;
      }
  return true;
}

}  // namespace

Result<SegmentsFile> onGrid(SegmentsFile file, const VoxelGeometry& grid) {
  if (file.maps.empty()) return file;
  const VoxelGeometry own = file.maps.front().labels.geometry();
  if (!own.calibrated || !grid.calibrated) {
    if (own.size != grid.size)
      return Error{"The segments have " + sizeText(own.size) + " voxels and the series " +
                   sizeText(grid.size) + ", and where they lie is not known."};
    for (Segmented& map : file.maps) {
      DenseLabels labels = map.labels.dense();
      labels.geometry = grid;
      map.labels = LabelMap(labels);
    }
    return file;
  }
  const bool isSame = areSameVoxels(own, grid);
  bool isMoved = false, isCut = false;
  for (Segmented& map : file.maps) {
    for (const Segment& s : map.segments) {
      const auto box = isSame ? std::nullopt : maskOf(map.labels, std::uint8_t(s.number)).box();
      isMoved = isMoved || box;
      isCut = isCut || (box && !liesIn(*box, own, grid));
    }
    map.labels = labelsOn(map.labels, grid);
  }
  if (isMoved)
    file.notes.push_back("The segments lie on another grid (" + sizeText(own.size) +
                         " voxels): each voxel of the series has what the nearest of them has.");
  if (isCut) file.notes.emplace_back("Parts of the segments lie outside the series, and were left out.");
  return file;
}

}  // namespace volumen
