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
  std::size_t segment = 0;  ///< Index of its segment
  glm::dvec3 origin{0};     ///< Centre of its first pixel in patient space, mm
};

/// A DICOM segmentation object (PS3.3 A.51): planes of one size and orientation, one segment each. Segments
/// may overlap. In fractional segmentations, pixels with a fraction of at least 1/2 are set.
struct Segmentation {
  bool fractional = false;
  glm::ivec2 size{0};                        ///< Columns, rows
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< Unit vectors along a row and down a column, LPS
  glm::dvec2 mm{1};                          ///< Spacing of columns and of rows
  double thickness = 1;                      ///< Thickness of a plane, mm
  std::vector<Segment> segments;
  std::vector<SegmentFrame> frames;
  std::vector<std::uint8_t> bits;  ///< Pixels, frame after frame (packed_bits.h)
  std::vector<std::string> notes;  ///< Notes to the user, whole sentences

  /// Returns the index of the first bit of a row.
  std::size_t rowAt(std::size_t frame, int y) const {
    return (frame * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x);
  }
  bool isSet(std::size_t frame, int x, int y) const { return bitAt(bits, rowAt(frame, y) + std::size_t(x)); }
};

/// Returns the number of set pixels of a segment in all its frames.
std::int64_t pixelsOf(const Segmentation& segmentation, std::size_t segment);

/// Returns the grid of the segmentation's own planes, including empty ones between them. Returns an Error if
/// the planes are not evenly spaced or the grid would have 2^31 voxels or more.
Result<VoxelGeometry> gridOf(const Segmentation& segmentation);

/// Tests whether points lie in a segment. A point does if the nearest plane of the segment is at most half
/// its thickness away and its nearest pixel is set. The segmentation must outlive this object.
class SegmentPlaces {
 public:
  SegmentPlaces(const Segmentation& segmentation, std::size_t segment);

  bool holds(glm::dvec3 pPatient) const;
  /// Tests points on a line. The first is `pFirst`, and each is `step` (mm) after the one before. Writes 1
  /// for points inside, else 0.
  void holdsAlong(glm::dvec3 pFirst, glm::dvec3 step, std::span<std::uint8_t> held) const;
  /// Sets the voxels of slice `k` of a mask whose centre lies in the segment. Fast if a plane matches the
  /// slice pixel by voxel.
  void fill(BitMask& mask, int k) const;
  /// Returns the corners of the planes' bounding box, grown by half a pixel and half a plane; empty if there
  /// are no planes.
  std::vector<glm::dvec3> corners() const;

 private:
  struct Plane {
    double along;  ///< Position along the normal, mm
    std::size_t frame;
  };

  struct Pixel {
    std::size_t frame;
    glm::dvec2 at;  ///< Column and row; integers are pixel centres
  };
  /// Returns the nearest plane to a position along the normal in mm; null if it is too far away.
  const Plane* planeAt(double along) const;
  Pixel pixelOf(const Plane& plane, glm::dvec3 pPatient) const;
  bool isSet(const Pixel& pixel) const;
  /// Returns the pixel in the nearest plane; empty if that plane is too far away.
  std::optional<Pixel> pixelAt(glm::dvec3 pPatient) const;
  /// Returns the plane whose pixels match the voxels of a slice one by one, each nearest to its own; empty if
  /// there is none.
  std::optional<std::size_t> frameOn(const VoxelGeometry& grid, int k) const;

  const Segmentation& all_;
  glm::dvec3 normal_;
  std::vector<Plane> planes_;  ///< Planes of the segment, in order
};

/// Returns the voxels of a grid whose centre lies in the segment. Runs on all cores.
BitMask maskOf(const Segmentation& segmentation, std::size_t segment, const VoxelGeometry& grid,
               const CancelToken& cancel = {});

/// Returns all segments on a grid, ready for editing. They share one label map unless they overlap. A
/// segment that shares a voxel with others, or finds no free label, goes to the first further map where it
/// fits. Labels are the segment numbers of the file if possible. The result is incomplete if cancelled.
/// If the grid was resampled from `slices` and each plane lies on one of them, labels on the acquired slices
/// are returned too. Each grid slice then has the labels of the nearest one.
std::vector<Segmented> segmentedOf(const Segmentation& segmentation, const VoxelGeometry& grid,
                                   const CancelToken& cancel = {}, const AcquiredSlices& slices = {});

}  // namespace volumen
