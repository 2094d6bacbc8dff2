#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// An outline drawn by hand over a 3D picture. It cuts along the lines of sight through the whole volume.
struct Lasso {
  glm::dvec3 origin{0};  ///< Perspective: the eye; parallel: the point at (0, 0); patient space, mm
  /// Axes of the picture: orthogonal unit vectors in patient space.
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};
  bool perspective = false;
  /// Points along `right` and `down`, mm; for perspective, at 1 mm in front of the eye. The outline is
  /// closed.
  std::vector<glm::dvec2> points;
  bool inside = true;  ///< True cuts away the inside, false the outside, including everything behind the eye
  bool operator==(const Lasso&) const = default;

  glm::dvec3 forward() const { return glm::cross(right, down); }
};

/// The parts of a volume to remove.
struct Mask {
  bool tableRemoved = false;                         ///< Removes everything outside patientMask()
  std::vector<std::shared_ptr<const Lasso>> lassos;  ///< In drawing order; none is null
  bool operator==(const Mask& other) const;
  bool empty() const { return !tableRemoved && lassos.empty(); }
};

/// Returns the voxels that stay. The centre of a voxel decides; outlines follow the non-zero winding rule.
/// Values must be HU if the table is removed.
BitMask keptVoxels(const Volume& volume, const Mask& mask, const CancelToken& cancel = {});

/// Returns the voxels in a range (range.h) that the mask keeps. Removed voxels are in no range, though they
/// are shown as air.
BitMask keptVoxelsInRange(const Volume& volume, ValueRange range, const Mask& mask,
                          const CancelToken& cancel = {});

/// Applies a lasso to a set of voxels as keptVoxels() does. Only voxels within `withinMm` of its origin along
/// the line of sight are cut away.
BitMask leftBy(BitMask mask, const Lasso& lasso, double withinMm, const CancelToken& cancel = {});

/// Returns a copy of the volume filled with air (-1000, or the nearest value present) where the mask removes
/// voxels; its attributes record this. The Error means: cancelled, no patient found for removing the table,
/// or too little memory.
Result<VolumePtr> masked(const Volume& volume, const Mask& mask, const CancelToken& cancel = {});

/// Returns a copy of the volume filled with air, as in masked(), outside `kept` (same grid). `tableRemoved`
/// records in the attributes that `kept` leaves the table out. The Error means: cancelled, or too little
/// memory.
Result<VolumePtr> keptAlone(const Volume& volume, const BitMask& kept, const CancelToken& cancel = {},
                            bool tableRemoved = false);

/// Applies more outlines to `cut`, a result of masked(). Equal to masked() with `lassos` appended to the
/// mask, at the cost of the new outlines only. The Error means: cancelled, or too little memory.
Result<VolumePtr> cutFurther(const Volume& cut, std::span<const std::shared_ptr<const Lasso>> lassos,
                             const CancelToken& cancel = {});

}  // namespace volumen
