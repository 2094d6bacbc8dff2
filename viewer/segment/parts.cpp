#include "viewer/segment/parts.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace volumen {

namespace {

std::vector<RowStep> earlierRows(Neighbours neighbours) {
  const int alongI = neighbours == Neighbours::faces ? 0 : 1, oblique = neighbours == Neighbours::corners;
  std::vector<RowStep> steps{{-1, 0, alongI}, {0, -1, alongI}};
  if (neighbours != Neighbours::faces) steps.insert(steps.end(), {{-1, -1, oblique}, {1, -1, oblique}});
  return steps;
}

}  // namespace

Parts::Parts(const BitMask& mask, Neighbours neighbours, const CancelToken& cancel)
    : geometry_(mask.geometry()), joined_(joinedRuns(mask, earlierRows(neighbours), cancel)) {
  std::vector<std::int64_t> sizes(joined_.parts);
  for (const VoxelRun& run : joined_.runs) sizes[run.part] += run.end - run.begin;
  std::vector<std::uint32_t> order(joined_.parts), place(joined_.parts);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater(), [&](std::uint32_t part) { return sizes[part]; });
  for (const std::uint32_t part : order) {
    place[part] = std::uint32_t(sizes_.size());
    sizes_.push_back(sizes[part]);
  }
  for (VoxelRun& run : joined_.runs) run.part = place[run.part];
}

std::size_t Parts::of(glm::ivec3 voxel) const {
  const glm::ivec3 size = geometry_.size;
  for (int axis = 0; axis < 3; ++axis)
    if (voxel[axis] < 0 || voxel[axis] >= size[axis]) return count();
  const std::size_t row = std::size_t(voxel.z) * std::size_t(size.y) + std::size_t(voxel.y);
  const auto begin = joined_.runs.begin() + std::ptrdiff_t(joined_.firstOfRow[row]),
             end = joined_.runs.begin() + std::ptrdiff_t(joined_.firstOfRow[row + 1]);
  const auto run = std::upper_bound(begin, end, voxel.x, [](int x, const VoxelRun& r) { return x < r.end; });
  return run != end && run->begin <= voxel.x ? run->part : count();
}

BitMask Parts::mask(const std::vector<bool>& chosen) const { return maskOfRuns(joined_, geometry_, chosen); }

BitMask Parts::largest(std::size_t wanted) const {
  std::vector<bool> chosen(count());
  std::fill_n(chosen.begin(), std::min(wanted, count()), true);
  return mask(chosen);
}

BitMask Parts::atLeast(std::int64_t voxels) const {
  return largest(std::size_t(std::ranges::partition_point(sizes_, [&](auto size) { return size >= voxels; }) -
                             sizes_.begin()));
}

std::vector<bool> Parts::holding(std::span<const glm::ivec3> voxels) const {
  std::vector<bool> chosen(count() + 1);
  for (const glm::ivec3 voxel : voxels) chosen[of(voxel)] = true;
  chosen.pop_back();
  return chosen;
}

BitMask Parts::touched(std::span<const glm::ivec3> voxels) const { return mask(holding(voxels)); }

BitMask Parts::untouched(std::span<const glm::ivec3> voxels) const {
  std::vector<bool> chosen = holding(voxels);
  chosen.flip();
  return mask(chosen);
}

}  // namespace volumen
