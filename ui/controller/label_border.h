#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <utility>

#include "ui/controller/segment_layer.h"

namespace volumen {

/// Where the shown labels of a layer lie on a plane. What is shown there is their number in the layer's list,
/// from 1; 0: none of them.
class LabelBorder {
 public:
  LabelBorder(const SegmentLayer& layer, const SlicePlane& plane);

  /// Between which pixels of a row, the last one not among them, there may be labels: a little more than
  /// needed.
  std::pair<int, int> pixelsOfRow(int y) const;
  /// So many places along each side of a pixel meet every label that a single voxel on the plane has.
  int placesPerPixel() const;

  /// Reads places, quickest those beside the last one. For one thread.
  class Reader {
   public:
    explicit Reader(const LabelBorder& border) : of_(border) {}
    /// At a place in the picture (the centre of pixel (x, y) is (x + 1/2, y + 1/2)): what the nearest voxel
    /// has where the plane shows nearest voxels, else what has the largest share of the eight voxels around
    /// by linear interpolation; of equal shares the first of the list wins, and the background never.
    std::uint8_t at(glm::dvec2 pPixel);

   private:
    void read(glm::ivec3 cell);
    void setKinds(const std::array<std::uint8_t, 8>& labels);
    std::uint8_t largestShare(glm::dvec3 within) const;

    struct Kind {
      std::uint8_t shown;
      std::array<double, 8> corners;  // 1 where a voxel is of this kind, i fastest
    };
    const LabelBorder& of_;
    glm::ivec3 cell_{-1};          // of the voxels that were read last, the first one
    std::array<Kind, 8> kinds_{};  // of these voxels, as in the list, the background last
    int kindCount_ = 0;
  };

 private:
  std::array<std::uint8_t, 256> shownAs_{};  // by label
  std::shared_ptr<const LabelMap> map_;
  bool nearest_;
  glm::ivec2 size_;                  // of the picture
  glm::dvec3 first_, right_, down_;  // voxels: the picture's corner, and a pixel on
  glm::dvec3 low_, high_;            // voxels: of the box with labels
};

}  // namespace volumen
