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
  double mean = 0;       ///< of the ball, real units
  glm::dvec3 centre{0};  ///< of the ball, patient mm
};

/// The radius of a ball of 1 ml, mm.
extern const double peakRadius;

/// A voxel that a ball about the centre of another one reaches, and how much of it lies inside, 0 to 1.
struct BallVoxel {
  glm::ivec3 step{0};  ///< from the voxel in the middle
  double share = 0;
};

/// All of a ball of this radius, mm; the shares are good to 1e-3 of the ball's volume in sum. Empty where the
/// ball is one of more than a million voxels.
std::vector<BallVoxel> ballVoxels(const VoxelGeometry& geometry, double radius);

/// The largest mean over balls of 1 ml about these voxels of a volume, which may reach beyond them: each
/// voxel counts by its share inside the ball; padding and what lies outside the volume does not count. Of
/// equal ones the first. On all cores. None: no voxels, voxels too small (ballVoxels()), a volume that is not
/// calibrated, or it was cancelled.
std::optional<ValuePeak> peakAbout(std::span<const glm::ivec3> voxels, const Volume& volume,
                                   const CancelToken& cancel = {});
/// The same about the voxels of a region (forEachVoxelOf()).
std::optional<ValuePeak> regionPeak(const Shape& region, const Volume& volume,
                                    const CancelToken& cancel = {});

}  // namespace volumen
