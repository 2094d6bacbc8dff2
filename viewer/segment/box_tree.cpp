#include "viewer/segment/box_tree.h"

#include <algorithm>
#include <cassert>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// The ten lowest bits of a number, with two zeros between each.
std::uint64_t spread(std::uint32_t bits) {
  std::uint64_t x = bits & 0x3ff;
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

SpaceBox boxAbout(const SpaceBox& a, const SpaceBox& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

// Boxes about four of these each.
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

// The items along a Z-order curve through their middles (Morton 1966).
std::vector<std::uint32_t> alongCurve(std::span<const SpaceBox> items) {
  assert(!items.empty());
  SpaceBox all = items.front();
  for (const SpaceBox& item : items) all = boxAbout(all, item);
  const glm::vec3 scale = 1023.0f / glm::max(all.high - all.low, glm::vec3(1e-30f));
  std::vector<std::uint64_t> keys(items.size());
  parallelFor(std::int64_t(items.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = std::size_t(begin); n < std::size_t(end); ++n) {
      const glm::vec3 x = ((items[n].low + items[n].high) * 0.5f - all.low) * scale;
      const std::uint64_t code =
          spread(std::uint32_t(x.x)) | spread(std::uint32_t(x.y)) << 1 | spread(std::uint32_t(x.z)) << 2;
      keys[n] = code << 32 | n;
    }
  });
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order(items.size());
  std::ranges::transform(keys, order.begin(), [](std::uint64_t key) { return std::uint32_t(key); });
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

BoxTree::BoxTree(std::span<const SpaceBox> items) : order_(alongCurve(items)) {
  std::vector<SpaceBox> boxes(items.size());
  std::ranges::transform(order_, boxes.begin(), [&](std::uint32_t n) { return items[n]; });
  levels_.push_back({boxes.size(), groupsOf(boxes)});
  while (boxes.size() > fanOut) {
    boxes = boxesAbout(boxes);
    levels_.push_back({boxes.size(), groupsOf(boxes)});
  }
}

}  // namespace volumen
