#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "ui/controller/segment_layer.h"

namespace volumen {

/// Where the shown labels of a layer lie on a plane. What is shown is told by its number in the layer's list,
/// from 1; 0: none of them. The layer's map must outlive it.
class LabelReader {
 public:
  LabelReader(const SegmentLayer& layer, const SlicePlane& plane);

  /// How far it is from a pixel to the one right of it, and to the one below it, in voxels.
  glm::dvec2 voxelsPerPixel() const;
  /// Of a box that holds all that is shown, in the plane's patient space; none where the map has nothing.
  std::vector<glm::dvec3> corners() const;
  /// Writes what is shown at `pFirst` and at places each `step` right of the one before, in pixels of the
  /// picture: of the nearest voxel where the plane shows nearest voxels, else what has the largest share of
  /// the eight voxels around by linear interpolation; of equal shares the first of the list wins, and
  /// background (and what is hidden) never. Only what is not 0 is written for sure.
  void read(glm::dvec2 pFirst, double step, std::span<std::uint8_t> numbers) const;

 private:
  struct Line;
  class Shares;

  void readNearest(const Line& line, std::span<std::uint8_t> numbers) const;
  void readLargest(const Line& line, std::span<std::uint8_t> numbers) const;

  std::array<std::uint8_t, 256> shownAs_{};  // by label
  const LabelMap& map_;
  Rigid toPlane_;
  bool nearest_;
  glm::dvec3 first_, right_, down_;  // voxels: the picture's corner, and a pixel on
  glm::ivec3 low_, high_;            // of the box with labels, in voxels, the last ones not among them
};

}  // namespace volumen
