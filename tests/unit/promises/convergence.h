#pragma once

#include <string>
#include <vector>

#include "viewer/render/render.h"

namespace volumen::tests {

/// A closed-form value over patient space (mm), and a curve for it.
struct Field {
  const char* name;
  double (*value)(glm::dvec3 pMm);
  std::vector<CurvePoint> curve;
  double gradientFloor;  ///< value per mm
  double stepGridMm;     ///< voxels on which the steps below make errors above rounding
};

/// The fields of the phantoms soft-sphere, marschner-lobb (at their usual sizes, a part of 12 mm with the
/// surface or the finest waves in its middle) and ramp.
const std::vector<Field>& closedFormFields();

/// A cube of 12 mm of it, in voxels of h mm.
VolumePtr sampledField(const Field& field, double hMm);

/// What is seen of a field inside a clip box away from the edge, on a transparent background; no silhouette
/// of the box is in view: the picture is `pictureMm` high. Lit with an explicit gradientFloor, or unlit.
Scene sceneOf(const Field& field, bool lit, double pictureMm = 4);

/// The picture of the field itself: picture.md 4 to 6 integrated in steps of 1/200 mm, gradients by
/// differences.
Picture pictureOfField(const Field& field, const Scene& scene, glm::ivec2 size);

/// One measured error, over step (voxels), grid (mm) or pixel (mm).
struct ErrorAt {
  double h;
  PictureError error;
};

/// Plain steps of 2 .. 1/32 voxel against the limit (by brute force, in steps of 1/256). `options`: method
/// and so on.
std::vector<ErrorAt> errorOverStep(const Field& field, bool lit, const RenderOptions& options = {});
/// The reference on grids of 1/2 .. 1/8 mm against the picture of the field itself.
std::vector<ErrorAt> errorOverGrid(const Field& field, bool lit);
/// Pictures of 6 .. 48 pixels an edge of 1.5 mm, read bilinearly at the pixel centres of one of 96, against
/// the reference there.
std::vector<ErrorAt> errorOverPixel(const Field& field, bool lit, const RenderOptions& options = {});

/// The order of convergence: the slope of log RMSE over log h, by least squares.
double slopeOf(const std::vector<ErrorAt>& errors);

}  // namespace volumen::tests
