#pragma once

#include "tests/fixtures/chance.h"
#include "tests/fixtures/small_volumes.h"
#include "ui/controller/slice_service.h"

// Random requests for slices of a sheared grid.

namespace volumen::tests {

inline constexpr glm::ivec3 rampSize{40, 37, 35};  // more than one brick of labels along each axis

inline VolumePtr shearedRamp(double offset) {
  return volumeOf<std::int16_t>(rampSize, glm::dmat3(1.0, 0.1, 0, 0, 1.3, 0, 0, 0.2, 2.1),
                                [offset](glm::dvec3 p) { return offset + p.x * 7 + p.y * 3 - p.z * 5; });
}

inline std::shared_ptr<const LabelMap> chanceLabels(Chance& chance, const VoxelGeometry& grid) {
  LabelEdit edit{LabelMap(grid)};
  const glm::ivec3 low(chance.below(20), chance.below(20), chance.below(20));
  for (int n = chance.below(3000); n > 0; --n) {
    const glm::ivec3 at = low + glm::ivec3(chance.below(17), chance.below(17), chance.below(15));
    edit.set(at, std::uint8_t(1 + chance.below(3)));
  }
  return std::make_shared<const LabelMap>(edit.done());
}

inline SlicePlane chancePlane(Chance& chance) {
  SlicePlane plane;
  plane.centre = chance.vector() * 10.0;
  plane.right = glm::normalize(glm::dvec3(1, chance.between(-1, 1) * chance.below(2), 0));
  plane.down = glm::normalize(glm::cross(glm::dvec3(0, 0.3 * chance.below(2), 1), plane.right));
  plane.mmPerPixel = chance.between(0.4, 2);
  plane.size = {1 + chance.below(60), 1 + chance.below(60)};
  return plane;
}

inline SegmentLayer chanceSegments(Chance& chance, const VoxelGeometry& grid) {
  SegmentLayer layer;
  layer.labels = chanceLabels(chance, grid);
  for (const std::size_t label : {3u, 1u})
    layer.shown.push_back({label, qRgb(200, 20 * int(label), 90), 0.7});
  layer.opacity = chance.share();
  return layer;
}

inline SliceLayer plainLayer(VolumePtr volume, double opacity = 1) {
  SliceLayer layer;
  layer.volume = std::move(volume);
  layer.opacity = opacity;
  return layer;
}

inline SliceRequest requestUnder(VolumePtr volume, Chance& chance) {
  SliceRequest request;
  request.layers.push_back(plainLayer(std::move(volume)));
  request.plane = chancePlane(chance);
  return request;
}

}  // namespace volumen::tests
