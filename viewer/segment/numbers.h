#pragma once

#include <array>
#include <optional>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/in_plane.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// Statistics of a volume in real units (HU, SUV) over the voxels of a segment, without padding. Median and
/// percentiles are exact: the value of rank max(1, ceil(r N / 100)) of all N in ascending order (picture.md
/// 5).
struct SegmentValues {
  std::int64_t voxels = 0;  ///< Voxels with a value; if 0, all other members are 0
  double mean = 0, sd = 0;  ///< sd divides by n (population, not sample)
  double min = 0, max = 0, median = 0, p10 = 0, p90 = 0;
  glm::ivec3 maxAt{0};      ///< Voxel of the maximum; of equal maxima, the first in memory
  ValueCounts histogram{};  ///< Counts by binsFor()
};

/// Shape and position in patient space. Lengths, areas and volumes need a calibrated grid.
struct SegmentForm {
  double voxelMl = 0;    ///< Number of voxels x |det L|
  double surfaceMl = 0;  ///< Volume inside the drawn surface (occupancy.h)
  double areaMm2 = 0;    ///< Result of boundaryArea()
  glm::dvec3 centroid{0};
  VoxelBox box{};
  /// Unit vectors, longest axis first; the largest component of each is positive.
  std::array<glm::dvec3, 3> axes{};
  glm::dvec3 axisMm{0};  ///< "Axis by moments": 4 sqrt(eigenvalue of the covariance, dividing by n)
  double longestMm = 0;  ///< Largest distance between two points of the surface
  std::array<glm::dvec3, 2> longestAt{};
  InPlaneDiameters inPlane{};
  bool ofVoxelsAlone = false;  ///< True if surfaceMl, areaMm2 and the longest diameter were not computed
};

/// Returns the statistics. The result is the same for any number of threads.
SegmentValues valuesIn(const BitMask& mask, const Volume& volume);
/// Returns the form; empty if the mask is empty or its grid is not calibrated. The Error means: cancelled.
Result<std::optional<SegmentForm>> formOf(const BitMask& mask, const CancelToken& cancel = {});
/// Returns the form without the surface measures, which take most of the time and memory.
Result<std::optional<SegmentForm>> voxelFormOf(const BitMask& mask, const CancelToken& cancel = {});

/// Returns the voxels of a mask in memory order, as peakAbout() of viewer/measure takes them.
std::vector<glm::ivec3> voxelsOf(const BitMask& mask);

/// Similarity of two segments on one grid.
struct SegmentLikeness {
  std::optional<double> dice;          ///< 2 |A and B| / (|A| + |B|); empty if both are empty
  std::optional<double> differenceMl;  ///< Voxel volume of a minus that of b; empty if not calibrated
  /// Distances between the surfaces (occupancy.h) in mm, exact, from the centres of all triangles of one to
  /// the other; `largest` includes their corners. Distances below the float precision of the points are 0.
  /// Empty if one segment is empty or the grid is not calibrated.
  struct Distances {
    double largest = 0;  ///< Hausdorff distance
    double p95 = 0;      ///< Larger of the two directed 95th percentiles, by area
    double mean = 0;     ///< (sum a to b + sum b to a) / (area a + area b)
  };
  std::optional<Distances> distances;
};
/// Compares two segments. The Error means: cancelled, or too little memory.
Result<SegmentLikeness> likeness(const BitMask& a, const BitMask& b, const CancelToken& cancel = {});

}  // namespace volumen
