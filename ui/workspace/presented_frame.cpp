#include "ui/workspace/presented_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace volumen {

namespace {

/// The displayed area of a frame, in the frame's mm.
struct Displayed {
  PresentedGrid grid;
  glm::dvec3 right, down, centre;
  glm::dvec2 mm;  ///< size of a displayed pixel
};

Displayed displayedOf(const LoadedFrame& frame) {
  const VoxelGeometry& geometry = frame.geometry();
  const SlicePlane acquired = framePlane(geometry);
  const glm::ivec2 size(geometry.size);
  const PixelBox area = frame.how->area.value_or(PixelBox{{0, 0}, size - 1});
  const glm::dvec2 middle = glm::dvec2(area.from + area.to) / 2.0;
  const glm::dvec3 spacing = geometry.spacing();
  Displayed shown{PresentedGrid(*frame.how, size),
                  acquired.right,
                  acquired.down,
                  geometry.patientFromVoxel({middle, 0}),
                  {spacing.x, spacing.y}};
  if (frame.how->turn.quarters % 2) std::swap(shown.mm.x, shown.mm.y);
  turnAxes(frame.how->turn, shown.right, shown.down);
  return shown;
}

std::string opposite(std::string letters) {
  const std::string sides = "LRAPSI", others = "RLPAIS";
  for (char& letter : letters) letter = others[sides.find(letter)];
  return letters;
}

}  // namespace

SlicePlane presentedPlane(const LoadedFrame& frame, const FlatLook& look, SlicePlane plane) {
  const Displayed shown = displayedOf(frame);
  glm::dvec2 whole = glm::dvec2(shown.grid.size()) * shown.mm;
  if (look.turn.quarters % 2) std::swap(whole.x, whole.y);
  plane.mmPerPixel = std::max(whole.x / plane.size.x, whole.y / plane.size.y) / look.zoom;
  plane.right = shown.right;
  plane.down = shown.down;
  turnAxes(look.turn, plane.right, plane.down);
  plane.centre = shown.centre + look.panMm.x * plane.right + look.panMm.y * plane.down;
  return plane;
}

glm::dvec3 annotationPlace(const LoadedFrame& frame, glm::dvec2 position, AnnotationUnits units) {
  const Displayed shown = displayedOf(frame);
  const glm::dvec2 from = shown.grid.displayed(position, units) - glm::dvec2(shown.grid.size()) / 2.0;
  return shown.centre + from.x * shown.mm.x * shown.right + from.y * shown.mm.y * shown.down;
}

std::string frameSide(const LoadedFrame& frame, glm::dvec3 direction) {
  constexpr double along = 0.9;  // smallest cosine that counts as that direction
  const SlicePlane acquired = framePlane(frame.geometry());
  for (const auto& [axis, side] :
       {std::pair(acquired.right, &frame.rowSide), std::pair(acquired.down, &frame.columnSide)}) {
    const double cosine = glm::dot(direction, axis);
    if (std::abs(cosine) > along) return cosine > 0 ? *side : opposite(*side);
  }
  return {};
}

}  // namespace volumen
