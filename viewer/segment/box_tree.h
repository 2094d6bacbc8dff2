#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace volumen {

/// A box in patient space, mm.
struct SpaceBox {
  glm::vec3 low{0}, high{0};
};

/// Four boxes, stored by coordinate for SIMD. Missing boxes lie far away.
struct BoxGroup {
  std::array<std::array<float, 4>, 3> low, high;
};

/// A bounding volume hierarchy. Each box encloses four boxes or items below it; the top level has at most
/// four.
class BoxTree {
 public:
  static constexpr std::size_t fanOut = 4;

  /// Builds the tree over the boxes of the items; at least one.
  explicit BoxTree(std::span<const SpaceBox> items);

  /// Returns the item indices in tree order: box n of level 0 belongs to item order()[n].
  std::span<const std::uint32_t> order() const { return order_; }
  /// Returns the number of levels; the last level has one group.
  std::size_t levels() const { return levels_.size(); }
  /// Returns boxes 4n .. 4n + 3 of a level. Box m encloses the boxes of group m of the level below.
  const BoxGroup& group(std::size_t level, std::size_t n) const { return levels_[level].groups[n]; }
  /// Returns the number of boxes of a level.
  std::size_t boxes(std::size_t level) const { return levels_[level].boxes; }

 private:
  struct Level {
    std::size_t boxes;
    std::vector<BoxGroup> groups;
  };
  std::vector<std::uint32_t> order_;
  std::vector<Level> levels_;
};

}  // namespace volumen
