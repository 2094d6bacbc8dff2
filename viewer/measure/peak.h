#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "viewer/measure/shape.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The largest mean over a ball (SUVpeak: Wahl et al., J Nucl Med 2009; 50 Suppl 1: 122S, PERCIST).
struct ValuePeak {
  double mean = 0;       ///< Mean over the ball, real units.
  glm::dvec3 centre{0};  ///< Centre of the ball, patient mm.
};

/// The radius of a ball of 1 ml, mm.
extern const double peakRadius;

/// A voxel that a ball about the centre of another voxel reaches, and the share of it inside the ball, 0 to
/// 1.
struct BallVoxel {
  glm::ivec3 step{0};  ///< Offset from the voxel in the middle.
  double share = 0;
};

/// Returns all voxels of a ball of this radius, in mm. The sum of the shares is accurate to 1e-3 of the
/// ball's volume. Empty if the ball would hold more than about a million voxels.
std::vector<BallVoxel> ballVoxels(const VoxelGeometry& geometry, double radius);

/// Returns the largest mean over balls of 1 ml about the given voxels; the balls may extend beyond these.
/// Each voxel is weighted by its share inside the ball. Padding and positions outside the volume do not
/// count. Of equal means the first wins. Uses all cores. Empty if there are no voxels, voxels are too small
/// (ballVoxels()), the volume is not calibrated, or it was cancelled.
std::optional<ValuePeak> peakAbout(std::span<const glm::ivec3> voxels, const Volume& volume,
                                   const CancelToken& cancel = {});
/// Returns the same as peakAbout(), about the voxels of a region (forEachVoxelOf()).
std::optional<ValuePeak> regionPeak(const Shape& region, const Volume& volume,
                                    const CancelToken& cancel = {});

}  // namespace volumen
