#pragma once

#include <cstddef>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/slice/smooth_curve.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// How a volume is laid out flat along a curve (Kanitsar et al., CPR: curved planar reformation, IEEE
/// Visualization 2002).
enum class CurvedKind {
  straightened,  ///< the curve becomes a straight line, its cross-sections stand at right angles to it
  stretched      ///< the surface of straight lines in one direction through the curve is unrolled
};

/// What a curved volume is made by, beside the volume itself. Patient space, mm.
struct CurvedRecipe {
  CurvedKind kind = CurvedKind::straightened;
  std::vector<glm::dvec3> points;  ///< that the curve runs through
  glm::dvec3 ruled{0, 0, 1};       ///< of `stretched`: the direction of the straight lines, a unit vector
  double halfWidth = 25;           ///< how far it reaches across the curve, each way
  bool operator==(const CurvedRecipe&) const = default;
};

/// The direction in which a surface through these points is ruled: the normal of the plane that fits them
/// best, its largest component above 0; where they lie on a line, the one at right angles to that line that
/// is closest to `otherwise`. A unit vector.
glm::dvec3 ruledDirection(const std::vector<glm::dvec3>& points, glm::dvec3 otherwise);

/// Where the voxels of a curved volume come from. It has a space of its own, in mm. Of `straightened` z is 0
/// at the start of the curve and falls along it by arc length, or rises where the curve begins upwards; x and
/// y are across it, in a frame that does not turn about the curve (double reflection: Wang, Juettler, Zheng
/// and Liu, ACM Transactions on Graphics 27 (2008) 2). Of `stretched` x is the arc length of the curve as
/// seen along `ruled`, y is across the surface and z along `ruled`. Lengths along the curve and within a
/// cross-section are true, any other only near the curve.
class CurvedGrid {
 public:
  /// Voxels are as large as the source's smallest spacing, larger where there would be more than mostVoxels
  /// or mostSections; along the curve they are stretched a little so that its two ends have a cross-section
  /// each. An Error where SmoothCurve has one, there are more than mostPoints, the curve is shorter than a
  /// voxel or longer than `longest`, as seen along `ruled` too, a number of the recipe makes no sense, or the
  /// source is not calibrated.
  static Result<CurvedGrid> make(const CurvedRecipe& recipe, const VoxelGeometry& source);
  static constexpr double mostVoxels = 1 << 26, mostSections = 1 << 15;
  static constexpr std::size_t mostPoints = 2000;
  static constexpr double longest = 10000, mostAlongRuled = 100;  ///< mm

  /// Slices k are the cross-sections, from the start of the curve on.
  const VoxelGeometry& geometry() const { return geometry_; }
  /// The length of the curve that is laid out straight, mm.
  double length() const { return length_; }
  /// The place in the patient of one in the curved space.
  glm::dvec3 patientFromCurved(glm::dvec3 p) const;
  /// The place in the curved space of one in the patient, by the cross-section whose middle is nearest.
  glm::dvec3 curvedFromPatient(glm::dvec3 pPatient) const;

  /// How far along the curve that was drawn the cross-section of a place in the curved space lies, mm of arc
  /// length; of `stretched` that is more than its x where the curve leaves its plane.
  double alongCurve(glm::dvec3 p) const;

  /// A cross-section. Patient space.
  struct Section {
    glm::dvec3 at;  ///< on the curve, of `stretched` its foot on the plane along which it is seen, mm
    glm::dvec3 right, down, along;  ///< unit vectors: of voxels i and j, and of the curve, right x down
    double mm = 0;                  ///< arc length of the curve that was drawn, up to there
  };
  const std::vector<Section>& sections() const { return sections_; }

 private:
  CurvedGrid() = default;
  void setFrames();

  CurvedRecipe recipe_;
  double length_ = 0;
  glm::dmat3 axes_{1};  // of right, down and along in the curved space
  std::vector<Section> sections_;
  VoxelGeometry geometry_;
};

/// The values of `source` on the grid of the recipe, by trilinear interpolation as flat views have it
/// (slice.h), as float32 in real units. Voxels outside the source's box have a value that is left out of
/// statistics (VolumeAttributes::padding): the source's padding, else one below all others; so have those
/// that padding would have a part in. `progress` hears of each cross-section. An Error where CurvedGrid has
/// one, all of it lies outside the source, or it was cancelled.
Result<VolumePtr> curvedVolume(const Volume& source, const CurvedRecipe& recipe,
                               const std::function<void(std::size_t done, std::size_t total)>& progress = {},
                               const CancelToken& cancel = {});

}  // namespace volumen
