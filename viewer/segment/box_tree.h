#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace volumen {

/// A box of patient space, mm.
struct SpaceBox {
  glm::vec3 low{0}, high{0};
};

/// Four boxes, their coordinates beside each other so that vectors hold them; what is missing of them is far
/// away.
struct BoxGroup {
  std::array<std::array<float, 4>, 3> low, high;
};

/// Items of space, those near each other together: their boxes, boxes about four of these, and so on, up to
/// at most four. What is asked of an item is first asked of the boxes about it.
class BoxTree {
 public:
  static constexpr std::size_t fanOut = 4;

  /// Of the boxes of the items; at least one.
  explicit BoxTree(std::span<const SpaceBox> items);

  /// The items in the order of the tree: box n of level 0 is that of the n-th.
  std::span<const std::uint32_t> order() const { return order_; }
  /// The last has one group.
  std::size_t levels() const { return levels_.size(); }
  /// Boxes 4 n .. 4 n + 3 of a level; box m of it is about those of group m of the level below.
  const BoxGroup& group(std::size_t level, std::size_t n) const { return levels_[level].groups[n]; }
  /// How many boxes a level has.
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
