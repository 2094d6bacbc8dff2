#pragma once

#include <array>
#include <optional>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/in_plane.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// Values in real units of a volume (HU, SUV) at the voxels of a segment; padding is not among them. Median
/// and percentiles are exact: the values of rank max(1, ceil(r N / 100)) of all N in ascending order
/// (picture.md 5).
struct SegmentValues {
  std::int64_t voxels = 0;  ///< of which there is a value; of none all else here is 0
  double mean = 0, sd = 0;  ///< sd by n: of the voxels, not of a sample
  double min = 0, max = 0, median = 0, p10 = 0, p90 = 0;
  glm::ivec3 maxAt{0};      ///< voxel; of several the first in memory
  ValueCounts histogram{};  ///< in binsFor() them
};

/// Form and place, patient space. Lengths, areas, volumes only of calibrated grids.
struct SegmentForm {
  double voxelMl = 0;    ///< voxels x |det L|
  double surfaceMl = 0;  ///< inside its surface (occupancy.h), as it is drawn
  double areaMm2 = 0;    ///< boundaryArea()
  glm::dvec3 centroid{0};
  VoxelBox box{};
  std::array<glm::dvec3, 3> axes{};  ///< unit, longest first; the largest component of each is positive
  glm::dvec3 axisMm{0};              ///< "axis by moments": 4 sqrt(eigenvalue of the covariance, by n)
  double longestMm = 0;              ///< between two points of its surface
  std::array<glm::dvec3, 2> longestAt{};
  InPlaneDiameters inPlane{};
  bool ofVoxelsAlone = false;  ///< surfaceMl, areaMm2 and the longest diameter were not asked for
};

/// The same for any number of threads.
SegmentValues valuesIn(const BitMask& mask, const Volume& volume);
/// None where the mask is empty or its grid is not calibrated; the Error: cancelled.
Result<std::optional<SegmentForm>> formOf(const BitMask& mask, const CancelToken& cancel = {});
/// The same without what takes its surface: a small part of the time and of the memory.
Result<std::optional<SegmentForm>> voxelFormOf(const BitMask& mask, const CancelToken& cancel = {});

/// The voxels of a mask in memory order: about which peakAbout() of viewer/measure is asked.
std::vector<glm::ivec3> voxelsOf(const BitMask& mask);

/// How alike two segments of one grid are.
struct SegmentLikeness {
  std::optional<double> dice;          ///< 2 |A and B| / (|A| + |B|); none where both are empty
  std::optional<double> differenceMl;  ///< volume of a - volume of b, voxels; none: not calibrated
  /// Between their surfaces (occupancy.h), mm: from the middles of all triangles of one to the other, exact;
  /// the largest also from their corners. 0 where floats, which points are, tell none. None where one is
  /// empty or the grid is not calibrated.
  struct Distances {
    double largest = 0;  ///< Hausdorff
    double p95 = 0;      ///< the larger of both directed 95th percentiles, by area
    double mean = 0;     ///< (sum a to b + sum b to a) / (area a + area b)
  };
  std::optional<Distances> distances;
};
/// The Error: cancelled, or there is not enough memory.
Result<SegmentLikeness> likeness(const BitMask& a, const BitMask& b, const CancelToken& cancel = {});

}  // namespace volumen
