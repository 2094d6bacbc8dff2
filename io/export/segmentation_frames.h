#pragma once

#include <optional>
#include <vector>

#include "io/export/dicom_source.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/packed_bits.h"
#include "viewer/segment/segmented.h"

namespace volumen {

/// A segment on the displayed grid and, if known, on the acquired slices.
struct WrittenMask {
  BitMask drawn;
  std::optional<BitMask> onSlices{};
  bool isInterpolated = false;  ///< true if its voxels depend on resampled values
};
/// Returns the segment of this number.
WrittenMask writtenMask(const Segmented& map, int number);

/// Checks that all slices have a position. The Error names the file that has none.
Status checkPlaces(const Series& series, const DicomSource& source);

/// Masks as frames of one bit a pixel on the acquired slices of a DICOM series. A pixel is set if the voxel
/// that contains its centre is. Empty frames are left out.
class SegmentationFrames {
 public:
  /// `size` is columns x rows of every slice. All slices have a position.
  SegmentationFrames(const VoxelGeometry& grid, const DicomSource& source, glm::ivec2 size);

  /// Adds the frames of one more segment; `mask` has the constructor's grid. `onSlices` is the same segment
  /// on the acquired slices, one voxel a pixel, and is written instead if its size matches; null if unknown.
  void add(const BitMask& mask, const BitMask* onSlices = nullptr);

  struct Frame {
    int segment = 0;  ///< index from 0, in the order of add()
    int slice = 0;    ///< index in the source
  };
  const std::vector<Frame>& frames() const { return frames_; }
  glm::ivec2 size() const { return size_; }
  const BitPacker& bits() const { return bits_; }
  /// True if two segments share a voxel.
  bool overlap() const { return overlap_; }
  /// True if all segments were known on the acquired slices.
  bool areOfSlices() const { return areOfSlices_; }
  /// Returns the source slices that lie between grid slices, where the display is interpolated.
  std::vector<int> slicesBetween() const;
  /// True if the pixels of all slices lie on voxels of the grid.
  bool areOnGrid() const;
  /// Returns the number of grid slices with segments that no source slice lies on; only if areOnGrid().
  int slicesLeftOut() const;

 private:
  /// Returns the grid slice whose voxels match the pixels of `slice` one to one, each within half a voxel.
  std::optional<int> gridSliceOf(int slice) const;
  void readRow(const BitMask& mask, int slice, int y, std::span<std::uint64_t> words) const;
  bool isOfSlices(const BitMask& mask) const;
  glm::dvec3 voxelAt(int slice, glm::dvec2 pixel) const;

  const DicomSource& source_;
  glm::ivec2 size_;
  BitMask taken_;
  std::optional<BitMask> takenOnSlices_;
  bool overlap_ = false, areOfSlices_ = true;
  std::vector<std::optional<int>> gridSlices_;  // one for each slice of the source
  std::vector<Frame> frames_;
  int segments_ = 0;
  BitPacker bits_;
};

}  // namespace volumen
