#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "ui/controller/segment_layer.h"

namespace volumen {

/// Reads the visible labels of a layer on a plane. Labels are given as positions in the layer's list, from 1;
/// 0 is none. The layer's map must outlive the reader.
class LabelReader {
 public:
  LabelReader(const SegmentLayer& layer, const SlicePlane& plane);

  /// Returns the distance in voxels from a pixel to its right neighbour and to its lower neighbour.
  glm::dvec2 voxelsPerPixel() const;
  /// Returns the corners of a box around all visible labels, in the plane's patient space; empty if the map
  /// has none.
  std::vector<glm::dvec3> corners() const;
  /// Writes the labels at `pFirst` and at points `step` apart to its right, in pixels of the picture. If the
  /// plane shows nearest voxels, that voxel counts. Otherwise the label with the largest share of the eight
  /// surrounding voxels by linear interpolation counts. Of equal shares the first in the list wins;
  /// background and hidden labels never do. Only numbers other than 0 are certain to be written.
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
  glm::dvec3 first_, right_, down_;  // voxels: the picture's corner, and the steps of a pixel
  glm::ivec3 low_, high_;            // of the box with labels, in voxels; `high_` is exclusive
};

}  // namespace volumen
