#include "viewer/measure/frame_measure.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/measure/leg_axis.h"
#include "viewer/measure/lengths.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/two_lines.h"
#include "viewer/slice/smooth_curve.h"

namespace volumen {

namespace {

constexpr int centimetres = 3, seconds = 4;
constexpr double mmPerCm = 10;

// Units of PS3.3 C.8.5.5.1.15.
const char* unitText(int unit) {
  constexpr const char* units[] = {"",     "%",    "dB",     "cm",   "s",      "Hz",     "dB/s",
                                   "cm/s", "cm^2", "cm^2/s", "cm^3", "cm^3/s", "degrees"};
  return unit > 0 && unit < int(std::size(units)) ? units[unit] : "";
}

// Bounds are whole pixels, so the region extends half a pixel beyond them.
bool holds(const UltrasoundRegion& region, glm::dvec3 p) {
  return p.x >= region.from.x - 0.5 && p.x <= region.to.x + 0.5 && p.y >= region.from.y - 0.5 &&
         p.y <= region.to.y + 0.5;
}

bool isLength(const UltrasoundRegion& region) {
  return region.unitX == centimetres && region.unitY == centimetres && region.delta.x > 0 &&
         region.delta.y > 0;
}

std::int64_t pixelsOf(const UltrasoundRegion& region) {
  const glm::i64vec2 size = glm::i64vec2(region.to) - glm::i64vec2(region.from) + std::int64_t(1);
  return size.x * size.y;
}

// Returns the innermost region that holds a point, because an inset has its own scale. Among regions of equal
// size, one in cm is preferred. Null if there is none.
const UltrasoundRegion* regionAt(glm::dvec3 p, const std::vector<UltrasoundRegion>& regions) {
  const UltrasoundRegion* found = nullptr;
  for (const UltrasoundRegion& region : regions) {
    if (!holds(region, p)) continue;
    const std::int64_t more = found ? pixelsOf(region) - pixelsOf(*found) : -1;
    if (more < 0 || (more == 0 && isLength(region) && !isLength(*found))) found = &region;
  }
  return found;
}

bool areOfOneScale(const UltrasoundRegion& a, const UltrasoundRegion& b) {
  return &a == &b || (isLength(a) && isLength(b) && a.delta == b.delta);
}

// Returns the region of a shape if all its points lie in regions of one scale, else null.
const UltrasoundRegion* regionOf(const Shape& shape, const std::vector<UltrasoundRegion>& regions) {
  const UltrasoundRegion* first = shape.points.empty() ? nullptr : regionAt(shape.points[0], regions);
  const bool one = first && std::ranges::all_of(shape.points, [&](glm::dvec3 p) {
                     const UltrasoundRegion* region = regionAt(p, regions);
                     return region && areOfOneScale(*region, *first);
                   });
  return one ? first : nullptr;
}

// The size of a pixel, for lengths and areas.
struct Scale {
  glm::dvec2 size{1};
  bool mm = false;
  std::string word;
};

Scale scaleOf(const FramePixels& frame, const UltrasoundRegion* region) {
  if (region && isLength(*region)) return {region->delta * mmPerCm, true, {}};
  if (!frame.regions.empty() || frame.pixel.kind == PixelSizeKind::unknown) return {};
  return {frame.pixel.mm, true, pixelSizeWord(frame.pixel.kind)};
}

Shape scaled(Shape shape, glm::dvec2 size) {
  for (glm::dvec3& p : shape.points) p *= glm::dvec3(size, 1);
  return shape;
}

Measured numberOf(double number, const char* unit) {
  Measured measured;
  measured.number = number;
  measured.unit = unit;
  return measured;
}

// Returns a grid with pixels of this size.
VoxelGeometry gridOf(const Scale& scale) {
  VoxelGeometry geometry;
  const double least = std::min(scale.size.x, scale.size.y);
  geometry.patientFromVoxelStep = {{scale.size.x, 0, 0}, {0, scale.size.y, 0}, {0, 0, least}};
  return geometry;
}

Measured lengthOn(const Shape& shape, const Scale& scale) {
  const Length length = lengthOf(scaled(shape, scale.size).points, gridOf(scale));
  Measured measured = numberOf(length.mm, scale.mm ? "mm" : "px");
  measured.plusMinus = length.plusMinus;
  return measured;
}

// If all points coincide there is no curve, and the length is 0.
Measured curveOn(const Shape& shape, const Scale& scale) {
  Measured measured = lengthOn(shape, scale);
  if (const auto curve = SmoothCurve::through(scaled(shape, scale.size).points))
    measured.number = curve->length();
  return measured;
}

Measured regionOn(const Shape& shape, const Scale& scale, const FramePixels& frame) {
  Measured measured = numberOf(areaOf(outlineOf(scaled(shape, scale.size))), scale.mm ? "mm^2" : "px^2");
  if (!frame.colour())
    measured.values = regionValues(inSliceSpace(shape, frame.values->geometry()), *frame.values);
  return measured;
}

Result<Measured> probeOn(const Shape& shape, const FramePixels& frame, const std::string& valueUnit) {
  const glm::ivec3 size = frame.values->size();
  const glm::dvec3 p = shape.points[0];
  if (!(p.x >= -0.5 && p.x <= size.x - 0.5 && p.y >= -0.5 && p.y <= size.y - 0.5))
    return Error{"The point lies outside the picture."};
  ProbedVoxel voxel;
  voxel.index = glm::clamp(glm::ivec3(glm::floor(p + 0.5)), glm::ivec3(0), size - 1);
  const VoxelGeometry& geometry = frame.values->geometry();
  voxel.centre = geometry.patientFromVoxel(glm::dvec3(voxel.index));
  Measured measured;
  const auto value = [&](const VolumePtr& of) {
    return double(of->value(voxel.index.x, voxel.index.y, voxel.index.z));
  };
  if (frame.colour()) {
    measured.frame.emplace().rgb = {value(frame.values), value(frame.green), value(frame.blue)};
  } else {
    measured.number = value(frame.values);
    measured.unit = valueUnit;
    voxel.padding = isPadding(frame.values->attributes().padding, measured.number);
  }
  measured.voxel = voxel;
  return measured;
}

// Returns the position of a probe along an axis of a region, or the distance between the ends of a length.
// Time counts from the region's left edge if the file gives no origin.
std::optional<AxisReading> readingOn(const Shape& shape, const UltrasoundRegion& region, int axis) {
  const int unit = axis == 0 ? region.unitX : region.unitY;
  const double delta = region.delta[axis];
  if (!(delta > 0) || *unitText(unit) == 0) return {};
  if (shape.kind == ShapeKind::length)
    return AxisReading{delta * std::abs(shape.points[1][axis] - shape.points[0][axis]), unitText(unit)};
  const std::optional<double> zero =
      region.zero[axis] || unit != seconds ? region.zero[axis] : std::optional<double>(region.from[axis]);
  if (!zero || shape.kind != ShapeKind::probe) return {};
  return AxisReading{region.sign[axis] * delta * (shape.points[0][axis] - *zero), unitText(unit)};
}

Result<Measured> angleOn(const Shape& shape, const Scale& scale, const FramePixels& frame) {
  const glm::dvec2 size = scale.mm ? scale.size : frame.pixel.mm;
  const Result<double> angle = angleOf(scaled(shape, size).points, shape.kind == ShapeKind::cobb);
  if (!angle) return angle.error();
  return numberOf(*angle, "degrees");
}

Result<Measured> legAxisOn(const Shape& shape, const Scale& scale, const FramePixels& frame) {
  return measureLegAxis(scaled(shape, scale.mm ? scale.size : frame.pixel.mm).points, frame.outwards);
}

// The right angle is checked in the picture as displayed.
Result<Measured> twoLinesOn(const Shape& shape, const Scale& scale, const FramePixels& frame) {
  if (shape.kind == ShapeKind::bidirectional)
    if (const Status right = checkRightAngle(scaled(shape, frame.pixel.mm).points); !right)
      return right.error();
  return measureTwoLines(scaled(shape, scale.size), gridOf(scale), scale.mm ? "mm" : "px");
}

Result<Measured> measureByKind(const Shape& shape, const Scale& scale, const FramePixels& frame,
                               const std::string& valueUnit) {
  switch (shape.kind) {
    case ShapeKind::length:
    case ShapeKind::polyline:
      return lengthOn(shape, scale);
    case ShapeKind::openCurve:
      return curveOn(shape, scale);
    case ShapeKind::angle:
    case ShapeKind::cobb:
      return angleOn(shape, scale, frame);
    case ShapeKind::legAxis:
      return legAxisOn(shape, scale, frame);
    case ShapeKind::bidirectional:
    case ShapeKind::cardiothoracic:
      return twoLinesOn(shape, scale, frame);
    case ShapeKind::ellipse:
    case ShapeKind::rectangle:
    case ShapeKind::freehand:
      return regionOn(shape, scale, frame);
    case ShapeKind::probe:
      return probeOn(shape, frame, valueUnit);
    case ShapeKind::label:
      return Error{"A label has no number."};
    default:
      return Error{"An arrow has no number."};
  }
}

}  // namespace

Result<Measured> measureOnFrame(const Shape& shape, const FramePixels& frame, const std::string& valueUnit) {
  if (const Status valid = checkShape(shape); !valid) return valid.error();
  const UltrasoundRegion* region = regionOf(shape, frame.regions);
  const Scale scale = scaleOf(frame, region);
  Result<Measured> measured = measureByKind(shape, scale, frame, valueUnit);
  if (!measured) return measured;
  if (!measured->frame) measured->frame.emplace();
  FrameReading& said = *measured->frame;
  said.colour = frame.colour();
  const std::string& unit = measured->lines ? measured->lines->unit : measured->unit;
  if (unit == "mm" || unit == "mm^2") said.calibration = scale.word;
  if (region && !isLength(*region)) {
    said.across = readingOn(shape, *region, 0);
    said.down = readingOn(shape, *region, 1);
  }
  measured->valueUnit = valueUnit;
  return measured;
}

Shape inSliceSpace(Shape shape, const VoxelGeometry& slice) {
  for (glm::dvec3& p : shape.points) p = slice.patientFromVoxel(p);
  if (shape.plane)
    shape.plane = ShapePlane{slice.origin, glm::normalize(slice.patientFromVoxelStep[0]),
                             glm::normalize(slice.patientFromVoxelStep[1])};
  shape.frame.reset();
  return shape;
}

}  // namespace volumen
