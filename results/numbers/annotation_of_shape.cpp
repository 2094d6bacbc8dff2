#include "results/numbers/annotation_of_shape.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

struct ShapePart {
  GraphicType type = GraphicType::polyline;
  std::vector<glm::dvec3> points;
};

// Returns what a shape is drawn with, in its own space. `mm` is the size of that space's units.
std::vector<ShapePart> partsOf(const Shape& shape, const glm::dvec3& mm) {
  const std::vector<glm::dvec3>& p = shape.points;
  if (p.empty()) return {};
  if (ruleOf(shape.kind).twoLines)
    return {{GraphicType::polyline, {p[0], p[1]}}, {GraphicType::polyline, {p[2], p[3]}}};
  switch (shape.kind) {
    case ShapeKind::ellipse:
      return {{GraphicType::ellipse, axisEnds(shape, mm)}};
    case ShapeKind::rectangle:
      return {{GraphicType::polyline, cornersOf(shape)}};
    case ShapeKind::freehand:
      return {{GraphicType::polyline, closed(p)}};
    case ShapeKind::probe:
    case ShapeKind::label:
      return {{GraphicType::point, p}};
    default:
      return {{GraphicType::polyline, lineOf(shape, mm)}};
  }
}

// Adds the head of an arrow to its line from the tip to the other end.
void addHead(std::vector<glm::dvec2>& line) {
  constexpr double longest = 10, share = 0.3, halfWidth = 0.4;  // pixels, of the line, of the head's length
  const glm::dvec2 tip = line[0], way = line[1] - tip;
  const double length = glm::length(way);
  if (length <= 0) return;
  const glm::dvec2 back = way / length * std::min(longest, share * length),
                   side = halfWidth * glm::dvec2(-back.y, back.x);
  line = {line[1], tip, tip + back + side, tip, tip + back - side};
}

}  // namespace

std::optional<ShapeAnnotation> annotationOf(const Shape& shape, const MeasuredOn& on,
                                            const std::string& words, const std::string& layer) {
  const glm::dvec3 mm = shape.frame ? glm::dvec3(on.pixelMm, 1) : glm::dvec3(1);
  const ShapePlaces places(shape, on);
  ShapeAnnotation all;
  glm::dvec2 rightmost(-1);
  for (const ShapePart& part : partsOf(shape, mm)) {
    const auto placed = places.onPicture(ReportShape::Type::polyline, part.points);
    if (!placed) return {};
    all.picture = placed->pictures[0];
    Graphic graphic{
        part.type, AnnotationUnits::pixel, {placed->points.begin(), placed->points.end()}, false, layer};
    const auto right = std::ranges::max_element(graphic.points, {}, &glm::dvec2::x);
    if (right->x > rightmost.x) rightmost = *right;
    if (shape.kind == ShapeKind::arrow) addHead(graphic.points);
    if (shape.kind != ShapeKind::label) all.graphics.push_back(std::move(graphic));
  }
  if (all.picture.sopInstanceUid.empty()) return {};
  if (!words.empty())
    all.text = GraphicText{words, {}, GraphicText::Anchor{rightmost, AnnotationUnits::pixel, false}, layer};
  return all;
}

}  // namespace volumen
