#include "viewer/segment/box_tree.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace volumen {

namespace {

SpaceBox boxAbout(const SpaceBox& a, const SpaceBox& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

// Returns one bounding box for every four boxes.
std::vector<SpaceBox> boxesAbout(std::span<const SpaceBox> below) {
  std::vector<SpaceBox> boxes;
  boxes.reserve((below.size() + BoxTree::fanOut - 1) / BoxTree::fanOut);
  for (std::size_t n = 0; n < below.size(); ++n)
    if (n % BoxTree::fanOut == 0)
      boxes.push_back(below[n]);
    else
      boxes.back() = boxAbout(boxes.back(), below[n]);
  return boxes;
}

struct PlacedItem {
  glm::vec3 middle;
  std::uint32_t index;
};

// Orders items so that those of each tree box are adjacent. Splits at a box boundary across the longest side
// until four are left.
void arrange(std::span<PlacedItem> items) {
  if (items.size() <= BoxTree::fanOut) return;
  std::size_t ofBox = BoxTree::fanOut;  // capacity of the children's boxes
  while (ofBox * BoxTree::fanOut < items.size()) ofBox *= BoxTree::fanOut;
  const std::size_t half = ((items.size() + ofBox - 1) / ofBox + 1) / 2 * ofBox;
  glm::vec3 low = items[0].middle, high = low;
  for (const PlacedItem& item : items) low = glm::min(low, item.middle), high = glm::max(high, item.middle);
  const glm::vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::ranges::nth_element(items, items.begin() + std::ptrdiff_t(half), {}, [axis](const PlacedItem& item) {
    return std::pair(item.middle[axis], item.index);
  });
  arrange(items.first(half));
  arrange(items.subspan(half));
}

std::vector<std::uint32_t> arranged(std::span<const SpaceBox> items) {
  assert(!items.empty());
  std::vector<PlacedItem> placed;
  placed.reserve(items.size());
  for (const SpaceBox& item : items)
    placed.push_back({(item.low + item.high) * 0.5f, std::uint32_t(placed.size())});
  arrange(placed);
  std::vector<std::uint32_t> order(items.size());
  std::ranges::transform(placed, order.begin(), &PlacedItem::index);
  return order;
}

std::vector<BoxGroup> groupsOf(const std::vector<SpaceBox>& boxes) {
  constexpr float far = 1e30f;
  BoxGroup none;
  for (std::size_t a = 0; a < 3; ++a) none.low[a].fill(far), none.high[a].fill(far);
  std::vector<BoxGroup> groups((boxes.size() + BoxTree::fanOut - 1) / BoxTree::fanOut, none);
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    BoxGroup& group = groups[n / BoxTree::fanOut];
    for (std::size_t a = 0; a < 3; ++a) {
      group.low[a][n % BoxTree::fanOut] = boxes[n].low[int(a)];
      group.high[a][n % BoxTree::fanOut] = boxes[n].high[int(a)];
    }
  }
  return groups;
}

}  // namespace

BoxTree::BoxTree(std::span<const SpaceBox> items) : order_(arranged(items)) {
  std::vector<SpaceBox> boxes(items.size());
  std::ranges::transform(order_, boxes.begin(), [&](std::uint32_t n) { return items[n]; });
  levels_.push_back({boxes.size(), groupsOf(boxes)});
  while (boxes.size() > fanOut) {
    boxes = boxesAbout(boxes);
    levels_.push_back({boxes.size(), groupsOf(boxes)});
  }
}

}  // namespace volumen
