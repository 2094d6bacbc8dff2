#include "app/exports/plane_stack.h"

#include <algorithm>
#include <cmath>

#include "app/measured_shapes.h"
#include "io/export/dicom_elements.h"

namespace volumen {

namespace {

// Returns the only curve in the patient of a file of shapes.
Result<Shape> curveIn(const std::string& path) {
  auto shapes = readShapes(path);
  if (!shapes) return shapes.error();
  std::erase_if(*shapes,
                [](const Shape& shape) { return shape.kind != ShapeKind::openCurve || shape.frame; });
  if (shapes->size() == 1) return shapes->front();
  return Error{path + " holds " + (shapes->empty() ? "no curve" : "several curves") +
               " in the patient (openCurve); slices are laid across one."};
}

// Returns the distance from slice to slice; `otherwise` if neither it nor a slab is given.
double distanceOf(const ExportJob& job, double otherwise) {
  if (job.spacingMm) return *job.spacingMm;
  return job.plane.slabMm > 0 ? job.plane.slabMm : otherwise;
}

}  // namespace

Result<SliceStack> planeStack(const ExportJob& job, const AskedPlane& asked, const VoxelGeometry& geometry) {
  const auto plane = makePlane(job.plane, asked, geometry);
  if (!plane) return plane.error();
  const double distanceMm = distanceOf(job, wheelStep(geometry, plane->normal()));
  if (job.plane.at || job.plane.index || asked.centre) return SliceStack{*plane, 1, distanceMm};
  return stackThrough(geometry, *plane, distanceMm);
}

Result<SliceStack> curveStack(const ExportJob& job, const AskedPlane& asked, const VoxelGeometry& geometry) {
  constexpr double sideMm = 50;
  const auto shape = curveIn(job.shapes);
  if (!shape) return shape.error();
  const auto curve = SmoothCurve::through(shape->points);
  if (!curve) return Error{job.shapes + ": " + curve.message()};
  auto plane = makePlane(job.plane, asked, geometry);
  if (!plane) return plane.error();
  if (!asked.size) plane->size = glm::ivec2(int(std::ceil(sideMm / plane->mmPerPixel - 1e-6)));
  const glm::dvec3 voxel = geometry.spacing();
  const double distanceMm = distanceOf(job, std::min({voxel.x, voxel.y, voxel.z}));
  return stackAlong(*curve, inOneLine(shape->name), *plane, distanceMm);
}

}  // namespace volumen
