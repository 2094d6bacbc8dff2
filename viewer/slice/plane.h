#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/volume/volume.h"

namespace volumen {

/// How values between voxels are found (slices.md 1).
enum class Interpolation { nearest, linear, cubic };

/// What a slab shows of the samples along its normal (slices.md 1).
enum class SlabMode { max, min, mean };

/// A flat view through a volume (slices.md 1). Patient space, mm; pixels count from the top left corner.
struct SlicePlane {
  glm::dvec3 centre{0};                      ///< of the picture, mm
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< unit vectors, orthogonal
  double mmPerPixel = 1;                     ///< both directions
  glm::ivec2 size{1};                        ///< pixels
  double slabMm = 0;                         ///< thickness of the slab, centred on the plane; 0: one sample
  SlabMode slabMode = SlabMode::max;
  Interpolation interpolation = Interpolation::linear;
  bool average = false;  ///< k x k sub-samples a pixel where pixels are larger than voxels

  bool operator==(const SlicePlane&) const = default;

  /// right x down, a unit vector: away from who looks at it.
  glm::dvec3 normal() const;
  /// The patient position of a place in the picture; the centre of pixel (x, y) is (x + 1/2, y + 1/2).
  glm::dvec3 patientFromPixel(glm::dvec2 pPixel) const;
  /// The place in the picture of the point's foot on the plane.
  glm::dvec2 pixelFromPatient(glm::dvec3 pPatient) const;
};

/// Refused: directions that are no orthogonal unit vectors, sizes below 1 or above 2^28 pixels, pixels of no
/// size, a negative slab, numbers that are not finite. The sentence says which.
Status checkPlane(const SlicePlane& plane);

enum class NamedPlane { axial, coronal, sagittal };

/// The named plane through the volume's centre, with the smallest voxel spacing and the smallest size that
/// covers the volume's box.
SlicePlane namedPlane(const VoxelGeometry& geometry, NamedPlane name);

/// The plane of these directions (orthogonal unit vectors) with the same defaults.
SlicePlane planeAlong(const VoxelGeometry& geometry, glm::dvec3 right, glm::dvec3 down);

/// The smallest size in pixels at which this plane, about its centre, covers the volume's box.
glm::ivec2 sizeToCover(const VoxelGeometry& geometry, const SlicePlane& plane);

/// h of slices.md 1: one voxel along the unit vector `normal`, mm.
double voxelAlong(const VoxelGeometry& geometry, glm::dvec3 normal);

/// How many samples along the normal the plane's slab has, at least 1.
std::int64_t slabSamples(const SlicePlane& plane, const VoxelGeometry& geometry);

/// How many sub-samples a pixel are averaged along each of its sides, at least 1.
std::int64_t subSamples(const SlicePlane& plane, const VoxelGeometry& geometry);

/// The unit vector at right angles to the volume's slices, i x j.
glm::dvec3 sliceNormal(const VoxelGeometry& geometry);

/// From slice to slice along sliceNormal(), mm.
double sliceDistance(const VoxelGeometry& geometry);

/// A step of the wheel along `normal`: the spacing of the volume axis that lies closest to it, projected, mm.
double wheelStep(const VoxelGeometry& geometry, glm::dvec3 normal);

/// The plane moved along its normal onto the volume's slice `index` (from 0; between two where it is not
/// whole); none where it is not parallel to the slices within 1e-3.
std::optional<SlicePlane> onSlice(SlicePlane plane, const VoxelGeometry& geometry, double index);

}  // namespace volumen
