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
  double stepGridMm;     ///< voxel size at which the steps below make errors above rounding
};

/// Returns the fields of the phantoms soft-sphere, marschner-lobb and ramp at their usual sizes. Each is a
/// part of 12 mm with the surface or the finest waves in its middle.
const std::vector<Field>& closedFormFields();

/// Samples the field on a cube of 12 mm with voxels of `hMm` mm.
VolumePtr sampledField(const Field& field, double hMm);

/// Returns a scene of a field inside a clip box, on a transparent background. The picture is `pictureMm`
/// high, so that no edge of the box is in view. It is unlit, or lit with an explicit gradientFloor.
Scene sceneOf(const Field& field, bool lit, double pictureMm = 4);

/// Draws the closed-form field itself: picture.md 4 to 6 integrated in steps of 1/200 mm, with gradients by
/// differences.
Picture pictureOfField(const Field& field, const Scene& scene, glm::ivec2 size);

/// One measured error, over step (voxels), grid (mm) or pixel (mm).
struct ErrorAt {
  double h;
  PictureError error;
};

/// Returns the errors of plain steps of 2 .. 1/32 voxel against the limit (brute force in steps of 1/256).
/// `options` sets the method and more.
std::vector<ErrorAt> errorOverStep(const Field& field, bool lit, const RenderOptions& options = {});
/// Returns the errors of the reference on grids of 1/2 .. 1/8 mm against the picture of the field itself.
std::vector<ErrorAt> errorOverGrid(const Field& field, bool lit);
/// Returns the errors of pictures of 6 .. 48 pixels an edge of 1.5 mm against the reference at 96 pixels.
/// Pictures are interpolated bilinearly at the reference's pixel centres.
std::vector<ErrorAt> errorOverPixel(const Field& field, bool lit, const RenderOptions& options = {});

/// Returns the order of convergence: the slope of log RMSE over log h by least squares.
double slopeOf(const std::vector<ErrorAt>& errors);

}  // namespace volumen::tests
