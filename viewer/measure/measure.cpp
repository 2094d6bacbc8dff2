#include "viewer/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/measure/leg_axis.h"
#include "viewer/measure/lengths.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/two_lines.h"
#include "viewer/slice/plane.h"
#include "viewer/slice/smooth_curve.h"

namespace volumen {

namespace {

// Returns the unit of the grid: `calibrated`, or `otherwise` if the grid is not calibrated.
std::string inGridUnit(const VoxelGeometry& geometry, const char* calibrated, const char* otherwise) {
  return geometry.calibrated ? calibrated : otherwise;
}

Result<Measured> measureLength(const Shape& shape, const VoxelGeometry& geometry) {
  const Length length = lengthOf(shape.points, geometry, shape.softMm.value_or(0));
  Measured measured;
  measured.number = length.mm;
  measured.plusMinus = length.plusMinus;
  measured.unit = inGridUnit(geometry, "mm", "px");
  return measured;
}

// If all points coincide there is no curve, and the length is 0.
Result<Measured> measureCurve(const Shape& shape, const VoxelGeometry& geometry) {
  Result<Measured> measured = measureLength(shape, geometry);
  if (const auto curve = SmoothCurve::through(shape.points)) measured->number = curve->length();
  return measured;
}

Result<Measured> measureAngle(const Shape& shape) {
  const Result<double> angle = angleOf(shape.points, shape.kind == ShapeKind::cobb);
  if (!angle) return angle.error();
  Measured measured;
  measured.number = *angle;
  measured.unit = "degrees";
  return measured;
}

Result<Measured> measureRegion(const Shape& shape, const Volume& volume, const std::string& valueUnit,
                               const CancelToken& cancel) {
  const ShapePlane& plane = *shape.plane;
  const double half = wheelStep(volume.geometry(), plane.normal()) / 2;
  for (std::size_t n = 0; n < shape.points.size(); ++n)
    if (std::abs(glm::dot(plane.normal(), shape.points[n] - plane.centre)) > half)
      return Error{"points[" + std::to_string(n) + "] lies off the plane by more than half a voxel."};
  Measured measured;
  measured.number = areaOf(outlineOf(shape));
  measured.unit = inGridUnit(volume.geometry(), "mm^2", "px^2");
  measured.values = regionValues(shape, volume);
  if (isSuv(valueUnit)) measured.peak = regionPeak(shape, volume, cancel);
  return measured;
}

Result<Measured> measureProbe(const Shape& shape, const Volume& volume, const std::string& valueUnit) {
  const VoxelGeometry& geometry = volume.geometry();
  const glm::dvec3 x = geometry.voxelFromPatient(shape.points[0]);
  for (int a = 0; a < 3; ++a)
    if (!(x[a] >= -0.5 && x[a] <= geometry.size[a] - 0.5)) return Error{"The point lies outside the volume."};
  ProbedVoxel voxel;
  voxel.index = glm::clamp(glm::ivec3(glm::floor(x + 0.5)), glm::ivec3(0), geometry.size - 1);
  voxel.centre = geometry.patientFromVoxel(glm::dvec3(voxel.index));
  Measured measured;
  measured.number = double(volume.value(voxel.index.x, voxel.index.y, voxel.index.z));
  measured.unit = valueUnit;
  voxel.padding = isPadding(volume.attributes().padding, measured.number);
  measured.voxel = voxel;
  return measured;
}

Result<Measured> measureVolume(const Shape& shape, const Volume& volume, const CancelToken& cancel) {
  const Result<RangeVolume> segment = rangeVolume(volume, shape.range, cancel);
  if (!segment) return segment.error();
  const VoxelGeometry& geometry = volume.geometry();
  const double voxel = geometry.calibrated ? geometry.voxelVolume() / 1000 : 1;
  Measured measured;
  measured.number = double(segment->voxels) * voxel;
  measured.drawn = segment->drawnVoxels * voxel;
  measured.unit = inGridUnit(geometry, "ml", "voxels");
  measured.segment = *segment;
  return measured;
}

Result<Measured> measureByKind(const Shape& shape, const Volume& volume, const std::string& valueUnit,
                               const CancelToken& cancel) {
  switch (shape.kind) {
    case ShapeKind::length:
    case ShapeKind::polyline:
      return measureLength(shape, volume.geometry());
    case ShapeKind::openCurve:
      return measureCurve(shape, volume.geometry());
    case ShapeKind::angle:
    case ShapeKind::cobb:
      return measureAngle(shape);
    case ShapeKind::legAxis:
      return measureLegAxis(shape.points, 0);
    case ShapeKind::bidirectional:
      if (const Status right = checkRightAngle(shape.points); !right) return right.error();
      return measureTwoLines(shape, volume.geometry(), inGridUnit(volume.geometry(), "mm", "px"));
    case ShapeKind::cardiothoracic:
      return measureTwoLines(shape, volume.geometry(), inGridUnit(volume.geometry(), "mm", "px"));
    case ShapeKind::ellipse:
    case ShapeKind::rectangle:
    case ShapeKind::freehand:
      return measureRegion(shape, volume, valueUnit, cancel);
    case ShapeKind::probe:
      return measureProbe(shape, volume, valueUnit);
    case ShapeKind::arrow:
      return Error{"An arrow has no number."};
    case ShapeKind::label:
      return Error{"A label has no number."};
    case ShapeKind::volume:
      break;
  }
  return measureVolume(shape, volume, cancel);
}

}  // namespace

Result<Measured> measure(const Shape& shape, const Volume& volume, const std::string& valueUnit,
                         const CancelToken& cancel) {
  if (const Status valid = checkShape(shape); !valid) return valid.error();
  if (shape.frame) return Error{"It is drawn on a frame, not in the volume."};
  Result<Measured> measured = measureByKind(shape, volume, valueUnit, cancel);
  if (measured) measured->valueUnit = valueUnit;
  return measured;
}

bool isSuv(const std::string& valueUnit) { return valueUnit.starts_with("SUV"); }

void addOther(Measured& measured, const Shape& shape, const Volume& other, const Rigid& toOther,
              const std::string& valueUnit, const CancelToken& cancel) {
  if (!ruleOf(shape.kind).region) return;
  Shape there = shape;
  for (glm::dvec3& p : there.points) p = toOther(p);
  there.plane = ShapePlane{toOther(shape.plane->centre), toOther.rotation * shape.plane->right,
                           toOther.rotation * shape.plane->down};
  OtherValues& values = measured.other.emplace();
  values.unit = valueUnit;
  values.values = regionValues(there, other);
  if (isSuv(valueUnit)) values.peak = regionPeak(there, other, cancel);
}

}  // namespace volumen
