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

/// The surface of a segment as files hold it, and what is told of it.
struct SurfaceToWrite {
  /// Of the surface with all its triangles, where it was reduced.
  struct Unreduced {
    std::size_t triangles = 0;
    double insideMl = 0;
    double offMm = 0;  ///< how far the reduced one is off it at most (deviation())
  };

  std::string name;     ///< of the segment
  Surface surface{};    ///< empty where the segment has no voxels
  double voxelsMl = 0;  ///< volume of its voxels
  double insideMl = 0;  ///< volume inside the surface
  double areaCm2 = 0;
  std::size_t shells = 0;    ///< closed shells that the surface consists of, cavities among them
  std::size_t cavities = 0;  ///< shells that lie around a hole inside another one
  double largestShare = 1;   ///< volume inside the largest shell, as a share of that inside all but cavities
  std::optional<Unreduced> before{};
};

/// Of one segment of a map; with fewer triangles where `reducedByMm` is not 0 (reduced()). The Error:
/// cancelled, too little memory.
Result<SurfaceToWrite> surfaceToWrite(const Segmented& map, const Segment& segment, double reducedByMm,
                                      const CancelToken& cancel = {});
/// The same of each segment, in the order of the maps.
Result<std::vector<SurfaceToWrite>> surfacesToWrite(std::span<const Segmented> maps, double reducedByMm,
                                                    const CancelToken& cancel = {});

/// The map with the largest part of each segment alone: of the voxels that share faces, as surfaces join
/// them. Cancelled: as far as it has come by then.
Segmented withLargestParts(const Segmented& map, const CancelToken& cancel = {});

/// Sentences without what they are about: "12 triangles, 0.5 ml inside (0.6 ml by voxels), 3 cm^2.", "1
/// closed shell."; of a reduced one another one, how many there were.
std::vector<std::string> toldOf(const SurfaceToWrite& surface);

}  // namespace volumen
