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

/// An outline drawn by hand over a 3D picture, and which side of it is cut away: along the lines of sight,
/// through the whole volume.
struct Lasso {
  glm::dvec3 origin{0};  ///< perspective: the eye; parallel: what is seen at the point (0, 0); patient mm
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< of the picture: orthogonal unit vectors, patient space
  bool perspective = false;
  /// Along right and down, mm; perspective: at 1 mm in front of the eye. The last is joined to the first.
  std::vector<glm::dvec2> points;
  bool inside = true;  ///< what is inside is cut away; false: all else, behind the eye too
  bool operator==(const Lasso&) const = default;

  glm::dvec3 forward() const { return glm::cross(right, down); }
};

/// What is to be taken away from a volume.
struct Mask {
  bool tableRemoved = false;                         ///< what lies outside patientMask()
  std::vector<std::shared_ptr<const Lasso>> lassos;  ///< none is null; in the order in which they were drawn
  bool operator==(const Mask& other) const;
  bool empty() const { return !tableRemoved && lassos.empty(); }
};

/// What stays. A voxel is cut away where its centre is; where an outline crosses itself, all that it goes
/// around is inside (non-zero winding number). Of a mask without its table values must be HU.
BitMask keptVoxels(const Volume& volume, const Mask& mask, const CancelToken& cancel = {});

/// The voxels in a range (range.h) of what the mask leaves: what it takes away shows air elsewhere, and is in
/// no range.
BitMask keptVoxelsInRange(const Volume& volume, ValueRange range, const Mask& mask,
                          const CancelToken& cancel = {});

/// What a lasso leaves of a set of voxels, decided as in keptVoxels(). Only voxels within so many mm of its
/// origin along the line of sight are cut away; others stay.
BitMask leftBy(BitMask mask, const Lasso& lasso, double withinMm, const CancelToken& cancel = {});

/// A copy of a volume with air (-1000, or the nearest value that there is) where the mask takes away, which
/// its attributes say. The Error: it was cancelled, the table was to go and there is no patient, or too
/// little memory.
Result<VolumePtr> masked(const Volume& volume, const Mask& mask, const CancelToken& cancel = {});

/// A copy of a volume with air, as masked() has it, everywhere but at these voxels of its grid.
/// `tableRemoved`: they leave the table out, which its attributes say. The Error: it was cancelled, or too
/// little memory.
Result<VolumePtr> keptAlone(const Volume& volume, const BitMask& kept, const CancelToken& cancel = {},
                            bool tableRemoved = false);

/// The same as masked() with these outlines behind those of the mask that `cut` was made with; costs what
/// they cost. The Error: it was cancelled, or too little memory.
Result<VolumePtr> cutFurther(const Volume& cut, std::span<const std::shared_ptr<const Lasso>> lassos,
                             const CancelToken& cancel = {});

}  // namespace volumen
