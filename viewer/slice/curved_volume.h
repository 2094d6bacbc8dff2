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

/// Ways to lay a volume out flat along a curve (Kanitsar et al., CPR: curved planar reformation, IEEE
/// Visualization 2002).
enum class CurvedKind {
  straightened,  ///< The curve becomes a straight line with its cross-sections at right angles
  stretched      ///< The surface ruled through the curve in one direction is unrolled
};

/// Parameters of a curved volume. Patient space, mm.
struct CurvedRecipe {
  CurvedKind kind = CurvedKind::straightened;
  std::vector<glm::dvec3> points;  ///< Points on the curve
  glm::dvec3 ruled{0, 0, 1};       ///< Direction of the ruled lines of `stretched`, unit vector
  double halfWidth = 25;           ///< Extent across the curve to each side
  bool operator==(const CurvedRecipe&) const = default;
};

/// Returns the ruling direction for a surface through these points, a unit vector: the normal of the
/// best-fitting plane, with its largest component positive. If the points lie on a line, it is the
/// perpendicular to that line closest to `otherwise`.
glm::dvec3 ruledDirection(const std::vector<glm::dvec3>& points, glm::dvec3 otherwise);

/// Maps the voxels of a curved volume to the patient. The curved space has its own axes in mm.
/// For `straightened`, z is 0 at the start of the curve and decreases with arc length, or increases if the
/// curve starts upwards. x and y lie across the curve in a rotation-minimizing frame (double reflection:
/// Wang, Juettler, Zheng and Liu, ACM Transactions on Graphics 27 (2008) 2).
/// For `stretched`, x is the arc length of the curve seen along `ruled`, y lies across the surface, and z
/// along `ruled`. Lengths along the curve and within a cross-section are true; others hold only near the
/// curve.
class CurvedGrid {
 public:
  /// Voxels have the smallest spacing of the source, or more if mostVoxels or mostSections would be exceeded.
  /// Along the curve they are stretched slightly so that both ends have a cross-section. The Error means:
  /// SmoothCurve has one, there are more than mostPoints points, the curve (also seen along `ruled`) is
  /// shorter than a voxel or longer than `longest`, a parameter is invalid, or the source is not calibrated.
  static Result<CurvedGrid> make(const CurvedRecipe& recipe, const VoxelGeometry& source);
  static constexpr double mostVoxels = 1 << 26, mostSections = 1 << 15;
  static constexpr std::size_t mostPoints = 2000;
  static constexpr double longest = 10000, mostAlongRuled = 100;  ///< Limits in mm

  /// Slices k are the cross-sections, from the start of the curve on.
  const VoxelGeometry& geometry() const { return geometry_; }
  /// Returns the length of the straightened curve in mm.
  double length() const { return length_; }
  /// Converts a point from curved space to patient space.
  glm::dvec3 patientFromCurved(glm::dvec3 p) const;
  /// Converts a point from patient space to curved space, by the cross-section with the nearest centre.
  glm::dvec3 curvedFromPatient(glm::dvec3 pPatient) const;

  /// Returns the arc length (mm) on the drawn curve of the cross-section at a point in curved space. For
  /// `stretched` it exceeds x where the curve leaves its plane.
  double alongCurve(glm::dvec3 p) const;

  /// A cross-section in patient space.
  struct Section {
    glm::dvec3 at;                  ///< Point on the curve, for `stretched` projected onto the view plane, mm
    glm::dvec3 right, down, along;  ///< Unit vectors of voxels i and j and of the curve (right x down)
    double mm = 0;                  ///< Arc length of the drawn curve up to `at`
  };
  const std::vector<Section>& sections() const { return sections_; }

 private:
  CurvedGrid() = default;
  void setFrames();

  CurvedRecipe recipe_;
  double length_ = 0;
  glm::dmat3 axes_{1};  // right, down and along in curved space
  std::vector<Section> sections_;
  VoxelGeometry geometry_;
};

/// Returns the unit vector across a curve at `to` that one at `from`, close by, becomes with the least
/// rotation about the curve (double reflection, as in CurvedGrid). Only `at` and `along` of both are used.
glm::dvec3 carriedAcross(glm::dvec3 across, const CurvedGrid::Section& from, const CurvedGrid::Section& to);

/// Resamples `source` onto the grid of the recipe by trilinear interpolation, as in flat views (slice.h), to
/// float32 in real units. Voxels outside the source's box, or interpolated from padding, get padding that
/// statistics leave out (VolumeAttributes::padding): the source's, else a value below all others. `progress`
/// is called for each cross-section. The Error means: CurvedGrid has one, everything lies outside the source,
/// or cancelled.
Result<VolumePtr> curvedVolume(const Volume& source, const CurvedRecipe& recipe,
                               const std::function<void(std::size_t done, std::size_t total)>& progress = {},
                               const CancelToken& cancel = {});

}  // namespace volumen
