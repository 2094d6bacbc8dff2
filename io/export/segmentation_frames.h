#pragma once

#include <optional>
#include <vector>

#include "io/export/dicom_source.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/packed_bits.h"

namespace volumen {

/// Masks as frames of one bit a pixel on the slices of a DICOM series as acquired: a pixel is set where the
/// voxel that holds its centre is. Frames without a pixel are left out.
class SegmentationFrames {
 public:
  /// `columns` x `rows`: of every slice. All of them are placed.
  SegmentationFrames(const VoxelGeometry& grid, const DicomSource& source, glm::ivec2 size);

  /// Frames of one more segment; its mask is of the grid. `onSlices`: the same on the slices as acquired, a
  /// voxel a pixel, which is written where it has as many; null: it is not known.
  void add(const BitMask& mask, const BitMask* onSlices = nullptr);

  struct Frame {
    int segment = 0;  ///< from 0, in the order in which they were added
    int slice = 0;    ///< of the source
  };
  const std::vector<Frame>& frames() const { return frames_; }
  glm::ivec2 size() const { return size_; }
  const BitPacker& bits() const { return bits_; }
  /// Whether two segments share a voxel.
  bool overlap() const { return overlap_; }
  /// Whether all segments were known on the slices as acquired.
  bool areOfSlices() const { return areOfSlices_; }
  /// Slices of the source at which the grid has none: what is drawn there is interpolated.
  std::vector<int> slicesBetween() const;
  /// Whether slices lie on the grid pixel by voxel.
  bool areOnGrid() const;
  /// Slices of the grid with voxels of segments that no slice of the source lies on; only where areOnGrid().
  int slicesLeftOut() const;

 private:
  /// The slice of the grid whose voxels lie on the pixels of a slice one by one, each nearest to its own.
  std::optional<int> gridSliceOf(int slice) const;
  void readRow(const BitMask& mask, int slice, int y, std::span<std::uint64_t> words) const;
  bool isOfSlices(const BitMask& mask) const;
  glm::dvec3 voxelAt(int slice, glm::dvec2 pixel) const;

  const DicomSource& source_;
  glm::ivec2 size_;
  BitMask taken_;
  std::optional<BitMask> takenOnSlices_;
  bool overlap_ = false, areOfSlices_ = true;
  std::vector<std::optional<int>> gridSlices_;  // of each slice of the source
  std::vector<Frame> frames_;
  int segments_ = 0;
  BitPacker bits_;
};

}  // namespace volumen
