#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "io/report.h"
#include "io/study/loaded.h"
#include "io/study/series.h"
#include "viewer/measure/shape.h"

namespace volumen {

/// The images that a shape is measured on.
struct MeasuredOn {
  const Series* series = nullptr;
  VoxelGeometry grid{};                ///< the measured grid; unused for shapes on frames
  std::vector<SliceOrigin> origins{};  ///< as in Loaded: the acquired slice that each slice of `grid` is
  std::vector<double> places{};        ///< as in Loaded: acquired slices along k of `grid`; empty: its slices
  bool isTiled = false;   ///< its slices are tiles of one image (mosaic), so that pixels do not fit
  int frame = 0;          ///< index in the series of the frame that a shape is drawn on
  glm::dvec2 pixelMm{1};  ///< size of a pixel of that frame, or its proportions
};

/// Brings points of a shape to the images that it is measured on. Both must outlive the object.
class ShapePlaces {
 public:
  ShapePlaces(const Shape& shape, const MeasuredOn& on);

  /// Returns these points, in the shape's own space, as pixels of the acquired image that the whole shape
  /// lies on, within 0.01 mm; 0, 0 is the outer corner. Empty if there is none, or points lie beside it.
  std::optional<ReportShape> onPicture(ReportShape::Type type, const std::vector<glm::dvec3>& points) const;
  /// Returns the same, else points in patient space. The Error says why that is impossible.
  Result<ReportShape> shapeOf(ReportShape::Type type, const std::vector<glm::dvec3>& points) const;
  /// Returns the images next to the points of the shape, for shapes in patient space; all without points.
  std::vector<ReferencedPicture> nearest() const;

 private:
  std::size_t sliceCount() const;
  double placeOf(std::size_t slice) const;
  int nearestSlice(double k) const;
  std::optional<int> sliceOf(const std::vector<glm::dvec3>& points) const;
  bool areOn(const std::vector<glm::dvec3>& points, double k) const;
  glm::dvec3 pixelOf(glm::dvec3 p) const;
  bool isInside(glm::dvec3 pixel) const;
  ReferencedPicture pictureOf(int slice) const;

  const Shape& shape_;
  const MeasuredOn& on_;
  std::optional<int> slice_;
};

/// Returns the ends of an ellipse's long axis, then of the short one. `mm` is the size of the units that the
/// shape's points are in.
std::vector<glm::dvec3> axisEnds(const Shape& ellipse, const glm::dvec3& mm);
/// Returns the corners of a rectangle, the first one also last.
std::vector<glm::dvec3> cornersOf(const Shape& rectangle);
/// Returns the points that stand for a line: those of a curve are close together.
std::vector<glm::dvec3> lineOf(const Shape& shape, const glm::dvec3& mm);
/// Returns the points with the first one also last.
std::vector<glm::dvec3> closed(std::vector<glm::dvec3> points);

}  // namespace volumen
