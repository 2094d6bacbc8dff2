#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/segment/acquired_slices.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/packed_bits.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The pixels of one segment in one plane.
struct SegmentFrame {
  std::size_t segment = 0;  ///< index of its segment
  glm::dvec3 origin{0};     ///< patient position of the centre of its first pixel, mm
};

/// A segmentation object (PS3.3 A.51): planes of one size and direction, each of one segment. Segments may
/// overlap. Of a fractional one a pixel is set where its fraction is at least 1/2.
struct Segmentation {
  bool fractional = false;
  glm::ivec2 size{0};                        ///< columns, rows
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< unit vectors along a row and down a column, LPS
  glm::dvec2 mm{1};                          ///< from column to column, from row to row
  double thickness = 1;                      ///< of a plane, mm
  std::vector<Segment> segments;
  std::vector<SegmentFrame> frames;
  std::vector<std::uint8_t> bits;  ///< frame after frame (packed_bits.h)
  std::vector<std::string> notes;  ///< sentences that are to be known

  /// Which of the bits is the first of a row.
  std::size_t rowAt(std::size_t frame, int y) const {
    return (frame * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x);
  }
  bool isSet(std::size_t frame, int x, int y) const { return bitAt(bits, rowAt(frame, y) + std::size_t(x)); }
};

/// How many pixels of a segment are set, in all of its frames.
std::int64_t pixelsOf(const Segmentation& segmentation, std::size_t segment);

/// The grid of the segmentation's own planes, the empty ones between them included. An Error where they are
/// not evenly spaced, or would be 2^31 voxels or more.
Result<VoxelGeometry> gridOf(const Segmentation& segmentation);

/// Where a segment lies: at places whose nearest plane of the segment, at most half its thickness away, is
/// set at the nearest pixel. The segmentation must outlive it.
class SegmentPlaces {
 public:
  SegmentPlaces(const Segmentation& segmentation, std::size_t segment);

  bool holds(glm::dvec3 pPatient) const;
  /// The same of places on a line, each `step` (mm) from the one before: 1 where it holds one, else 0.
  void holdsAlong(glm::dvec3 pFirst, glm::dvec3 step, std::span<std::uint8_t> held) const;
  /// Slice `k` of a mask, whose voxels are set where this holds their centre. Fast where a plane lies on it
  /// pixel by voxel.
  void fill(BitMask& mask, int k) const;
  /// The corners of the box of its planes, half a pixel and half a plane larger; none where it has no planes.
  std::vector<glm::dvec3> corners() const;

 private:
  struct Plane {
    double along;  ///< mm along the normal
    std::size_t frame;
  };

  struct Pixel {
    std::size_t frame;
    glm::dvec2 at;  ///< column and row, of the pixel's centre whole numbers
  };
  /// The nearest plane at so many mm along the normal; null where that is too far away.
  const Plane* planeAt(double along) const;
  Pixel pixelOf(const Plane& plane, glm::dvec3 pPatient) const;
  bool isSet(const Pixel& pixel) const;
  /// In the nearest plane; none where that is too far away.
  std::optional<Pixel> pixelAt(glm::dvec3 pPatient) const;
  /// The plane whose pixels lie on the voxels of a slice one by one, each nearest to its own; none where
  /// there is none.
  std::optional<std::size_t> frameOn(const VoxelGeometry& grid, int k) const;

  const Segmentation& all_;
  glm::dvec3 normal_;
  std::vector<Plane> planes_;  ///< of the segment, in order
};

/// A segment on a grid: the voxels whose centre it holds. On all cores.
BitMask maskOf(const Segmentation& segmentation, std::size_t segment, const VoxelGeometry& grid,
               const CancelToken& cancel = {});

/// All segments on a grid, to be edited. One label map as long as no two of them share a voxel; a segment
/// that overlaps others, or that has no label left, is in the first further map where it fits. Its number is
/// its label there: that of its file where it can be. A cancelled one is returned half done.
/// With `slices`, of which the grid is drawn, on these, too, where each of the planes lies on one of them.
std::vector<Segmented> segmentedOf(const Segmentation& segmentation, const VoxelGeometry& grid,
                                   const CancelToken& cancel = {}, const AcquiredSlices& slices = {});

}  // namespace volumen
