#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ui/controller/label_border.h"

namespace volumen {

/// How much of each pixel of a plane each shown label covers, by sub-samples: at least 4 x 4 of the pixels at
/// borders, and at least one a voxel. Numbers are those in the layer's list, from 1; 0: none of them.
class LabelPixels {
 public:
  /// On all cores.
  LabelPixels(const SegmentLayer& layer, const SlicePlane& plane);

  /// The pixels from `low` on, before `high`, have all that there is; they alone may be asked for.
  glm::ivec2 low() const { return low_; }
  glm::ivec2 high() const { return low_ + size_; }

  static constexpr std::uint8_t mixed = 255;
  /// What covers all of a pixel and of those up to two pixels from it; `mixed` where more than one does.
  std::uint8_t inside(int x, int y) const { return inside_[place(x, y)]; }

  struct Part {
    std::uint8_t shown = 0;
    bool isLast = false;  // of its pixel
    float covered = 0;    // 0 to 1
  };
  /// Calls use(number, covered) for what a pixel shows.
  template <class Use>
  void forParts(int x, int y, const Use& use) const {
    const std::uint8_t whole = whole_[place(x, y)];
    if (whole != mixed) {
      if (whole != 0) use(whole, 1.0F);
      return;
    }
    for (const Part* part = partsOf(x, y);; ++part) {
      if (part->shown != 0) use(part->shown, part->covered);
      if (part->isLast) return;
    }
  }
  /// How much of a pixel it covers.
  float covered(int x, int y, std::uint8_t shown) const {
    const std::uint8_t whole = whole_[place(x, y)];
    if (whole != mixed) return whole == shown ? 1 : 0;
    const Part* part = partsOf(x, y);
    while (part->shown != shown && !part->isLast) ++part;
    return part->shown == shown ? part->covered : 0;
  }

 private:
  std::size_t place(int x, int y) const {
    return std::size_t(y - low_.y) * std::size_t(size_.x) + std::size_t(x - low_.x);
  }
  const Part* partsOf(int x, int y) const {
    return &parts_[std::size_t(y - low_.y)][firstPart_[place(x, y)]];
  }
  void lookAtAll(const LabelBorder& border);
  void lookCloser(const LabelBorder& border);

  glm::ivec2 low_{0}, size_{0};
  std::vector<std::uint8_t> whole_;  // what covers all of a pixel, or mixed
  std::vector<std::uint8_t> inside_;
  std::vector<std::vector<Part>> parts_;        // of mixed pixels, by row
  std::unique_ptr<std::uint32_t[]> firstPart_;  // of mixed pixels, in its row
};

}  // namespace volumen
