#include "viewer/slice/presentation.h"

#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace volumen {
namespace {

/// Returns a turned position; `size` is that of the box before the turn.
glm::dvec2 turned(glm::dvec2 p, glm::dvec2 size, const PictureTurn& turn) {
  for (int n = 0; n < turn.quarters; ++n) {
    p = {size.y - p.y, p.x};
    std::swap(size.x, size.y);
  }
  return turn.mirrored ? glm::dvec2(size.x - p.x, p.y) : p;
}

std::vector<glm::dvec2> ellipseOutline(glm::dvec2 centre, glm::dvec2 a, glm::dvec2 b) {
  constexpr int pieces = 128;
  std::vector<glm::dvec2> line;
  for (int n = 0; n <= pieces; ++n) {
    const double angle = 2 * std::numbers::pi * (n % pieces) / pieces;
    line.push_back(centre + std::cos(angle) * a + std::sin(angle) * b);
  }
  return line;
}

/// Returns a Catmull-Rom curve through the points.
std::vector<glm::dvec2> smoothLine(const std::vector<glm::dvec2>& p) {
  constexpr int pieces = 16;
  const bool closed = p.size() > 2 && p.front() == p.back();
  const std::size_t last = p.size() - 1;
  std::vector<glm::dvec2> line{p.front()};
  for (std::size_t n = 0; n < last; ++n) {
    const glm::dvec2 before = n > 0 ? p[n - 1] : closed ? p[last - 1] : p[0];
    const glm::dvec2 after = n + 2 <= last ? p[n + 2] : closed ? p[1] : p[last];
    for (int k = 1; k <= pieces; ++k) {
      const double t = double(k) / pieces;
      line.push_back(0.5 * (2.0 * p[n] + t * (p[n + 1] - before) +
                            t * t * (2.0 * before - 5.0 * p[n] + 4.0 * p[n + 1] - after) +
                            t * t * t * (3.0 * p[n] - before - 3.0 * p[n + 1] + after)));
    }
  }
  return line;
}

}  // namespace

PictureTurn composed(PictureTurn first, PictureTurn second) {
  // A mirrored image turns the other way.
  const int turned = first.quarters + (first.mirrored ? -second.quarters : second.quarters);
  return {(turned % 4 + 4) % 4, first.mirrored != second.mirrored};
}

void turnAxes(PictureTurn turn, glm::dvec3& right, glm::dvec3& down) {
  for (int n = 0; n < turn.quarters; ++n) right = std::exchange(down, right) * -1.0;
  if (turn.mirrored) right = -right;
}

PresentedGrid::PresentedGrid(const FramePresentation& how, glm::ivec2 size)
    : area_(how.area.value_or(PixelBox{{0, 0}, size - 1})),
      turn_(how.turn),
      size_(area_.to - area_.from + 1) {
  if (turn_.quarters % 2 == 1) std::swap(size_.x, size_.y);
}

glm::ivec2 PresentedGrid::pixelAt(glm::ivec2 p) const {
  if (turn_.mirrored) p.x = size_.x - 1 - p.x;
  glm::ivec2 size = size_;
  for (int n = 0; n < turn_.quarters; ++n) {
    p = {p.y, size.x - 1 - p.x};
    std::swap(size.x, size.y);
  }
  return area_.from + p;
}

glm::dvec2 PresentedGrid::displayed(glm::dvec2 position, AnnotationUnits units) const {
  if (units == AnnotationUnits::display) return position * glm::dvec2(size_);
  return turned(position - glm::dvec2(area_.from), glm::dvec2(area_.to - area_.from + 1), turn_);
}

std::vector<glm::dvec2> outlineOf(const Graphic& graphic) {
  const std::vector<glm::dvec2>& p = graphic.points;
  switch (graphic.type) {
    case GraphicType::circle: {
      const double r = glm::distance(p[0], p[1]);
      return ellipseOutline(p[0], {r, 0}, {0, r});
    }
    case GraphicType::ellipse:
      return ellipseOutline((p[0] + p[1]) / 2.0, (p[1] - p[0]) / 2.0, (p[3] - p[2]) / 2.0);
    case GraphicType::interpolated:
      return smoothLine(p);
    case GraphicType::point:
    case GraphicType::polyline:
      break;
  }
  return p;
}

}  // namespace volumen
