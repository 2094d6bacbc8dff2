#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/dense_labels.h"
#include "viewer/segment/segment.h"
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
  std::vector<std::uint8_t> bits;  ///< frame after frame without a gap, lowest bit first

  bool isSet(std::size_t frame, int x, int y) const {
    const std::size_t bit =
        (frame * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x) + std::size_t(x);
    return bits[bit / 8] >> bit % 8 & 1;
  }
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
  /// The corners of the box of its planes, half a pixel and half a plane larger; none where it has no planes.
  std::vector<glm::dvec3> corners() const;

 private:
  struct Plane {
    double along;  ///< mm along the normal
    std::size_t frame;
  };

  const Segmentation& all_;
  glm::dvec3 normal_;
  std::vector<Plane> planes_;  ///< of the segment, in order
};

/// A segment on a grid: 1 at voxels whose centre it holds. Each segment gets a map of its own, for they may
/// overlap.
DenseLabels labelsOf(const Segmentation& segmentation, std::size_t segment, const VoxelGeometry& grid);

}  // namespace volumen
