#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/volume/volume.h"

namespace volumen {

/// Interpolation between voxels (slices.md 1).
enum class Interpolation { nearest, linear, cubic };

/// Projection of a slab's samples along its normal (slices.md 1).
enum class SlabMode { max, min, mean };

/// A flat view through a volume (slices.md 1). Patient space, mm; pixels count from the top left corner.
struct SlicePlane {
  glm::dvec3 centre{0};                      ///< Centre of the view, mm
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};  ///< Orthogonal unit vectors
  double mmPerPixel = 1;                     ///< Pixel size in both directions
  glm::ivec2 size{1};                        ///< Size in pixels
  double slabMm = 0;                         ///< Slab thickness, centred on the plane; 0 takes one sample
  SlabMode slabMode = SlabMode::max;
  Interpolation interpolation = Interpolation::linear;
  bool average = false;  ///< Averages k x k sub-samples per pixel where pixels are larger than voxels

  bool operator==(const SlicePlane&) const = default;

  /// Returns right x down, a unit vector that points away from the viewer.
  glm::dvec3 normal() const;
  /// Returns the patient position of a point in the view; the centre of pixel (x, y) is (x + 1/2, y + 1/2).
  glm::dvec3 patientFromPixel(glm::dvec2 pPixel) const;
  /// Returns the pixel position of a point projected onto the plane.
  glm::dvec2 pixelFromPatient(glm::dvec3 pPatient) const;
};

/// Returns an Error, naming the reason, for directions that are not orthogonal unit vectors, sizes below 1 or
/// above 2^28 pixels, pixels without size, a negative slab, or numbers that are not finite.
Status checkPlane(const SlicePlane& plane);

enum class NamedPlane { axial, coronal, sagittal };

/// Returns the named plane through the volume's centre, at the smallest voxel spacing and the smallest size
/// that covers the volume's box.
SlicePlane namedPlane(const VoxelGeometry& geometry, NamedPlane name);

/// Returns the plane with these directions (orthogonal unit vectors) and the same defaults.
SlicePlane planeAlong(const VoxelGeometry& geometry, glm::dvec3 right, glm::dvec3 down);

/// Returns the smallest size in pixels at which this plane covers the volume's box around its centre.
glm::ivec2 sizeToCover(const VoxelGeometry& geometry, const SlicePlane& plane);

/// Returns h of slices.md 1: one voxel along the unit vector `normal`, mm.
double voxelAlong(const VoxelGeometry& geometry, glm::dvec3 normal);

/// Returns the number of samples along the normal for the plane's slab, at least 1.
std::int64_t slabSamples(const SlicePlane& plane, const VoxelGeometry& geometry);

/// Returns the number of sub-samples along each side of a pixel, at least 1.
std::int64_t subSamples(const SlicePlane& plane, const VoxelGeometry& geometry);

/// Returns the unit normal of the volume's slices, i x j.
glm::dvec3 sliceNormal(const VoxelGeometry& geometry);

/// Returns the slice distance along sliceNormal(), mm.
double sliceDistance(const VoxelGeometry& geometry);

/// Returns the wheel step along `normal` in mm: the projected spacing of the volume axis closest to it.
double wheelStep(const VoxelGeometry& geometry, glm::dvec3 normal);

/// Moves the plane along its normal onto slice `index` of the volume (from 0; fractions lie between slices).
/// Empty if it is not parallel to the slices within 1e-3.
std::optional<SlicePlane> onSlice(SlicePlane plane, const VoxelGeometry& geometry, double index);

}  // namespace volumen
