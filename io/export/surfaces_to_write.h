#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/segment/segmented.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The surface of a segment as written to a file, and its measures for the user.
struct SurfaceToWrite {
  /// Measures of the surface before its triangles were reduced.
  struct Unreduced {
    std::size_t triangles = 0;
    double insideMl = 0;
    double offMm = 0;  ///< largest deviation of the reduced surface (deviation())
  };

  std::string name;     ///< the segment's name
  Surface surface{};    ///< empty if the segment has no voxels
  double voxelsMl = 0;  ///< volume of the segment's voxels
  double insideMl = 0;  ///< volume inside the surface
  double areaCm2 = 0;
  std::size_t shells = 0;    ///< closed shells of the surface, including cavities
  std::size_t cavities = 0;  ///< shells around a hole inside another shell
  /// volume inside the largest shell, as a share of that inside all shells but cavities
  double largestShare = 1;
  std::optional<Unreduced> before{};
};

/// Builds the surface of one segment of a map, reduced if `reducedByMm` is not 0 (reduced()). The Error:
/// cancelled, or too little memory.
Result<SurfaceToWrite> surfaceToWrite(const Segmented& map, const Segment& segment, double reducedByMm,
                                      const CancelToken& cancel = {});
/// Builds the surface of each segment, in the order of the maps.
Result<std::vector<SurfaceToWrite>> surfacesToWrite(std::span<const Segmented> maps, double reducedByMm,
                                                    const CancelToken& cancel = {});

/// Returns the map with only the largest connected component of each segment. Voxels that share faces are
/// connected, as in surfaces. A cancelled call returns the work done so far.
Segmented withLargestParts(const Segmented& map, const CancelToken& cancel = {});

/// Returns sentences without their subject: "12 triangles, 0.5 ml inside (0.6 ml by voxels), 3 cm^2.", "1
/// closed shell."; for reduced surfaces one more with the number of triangles before.
std::vector<std::string> toldOf(const SurfaceToWrite& surface);

}  // namespace volumen
