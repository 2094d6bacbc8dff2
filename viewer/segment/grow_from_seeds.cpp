#include "viewer/segment/grow_from_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "viewer/segment/bucket_queue.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/histogram.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using Cost = std::uint32_t;
constexpr Cost unreached = std::numeric_limits<Cost>::max();
constexpr double mostPerStep = 1 << 19;  // so that no path of a grid overflows

constexpr int tileEdge = LabelMap::edge;
constexpr int tileVoxels = tileEdge * tileEdge * tileEdge;
constexpr std::array<int, 3> tileStride = {1, tileEdge, tileEdge* tileEdge};

// How far paths are followed before tiles hear of each other: so many steps of the range of values.
constexpr Cost windowCosts = 2048;

// What seeds there are, and where.
struct SeedsFound {
  int labels = 0;
  VoxelBox box;
};

SeedsFound findSeeds(const LabelMap& seeds, const BitMask* within) {
  const glm::ivec3 grid = seeds.geometry().size, bricks = seeds.bricks();
  std::array<bool, 256> there{};
  SeedsFound found{0, {grid, glm::ivec3(-1)}};
  const auto add = [&](std::uint8_t label, glm::ivec3 low, glm::ivec3 high) {
    there[label] = true;
    found.box.low = glm::min(found.box.low, low);
    found.box.high = glm::max(found.box.high, high);
  };
  for (int n = 0; n < bricks.x * bricks.y * bricks.z; ++n) {
    const LabelMap::Brick& brick = seeds.brick(std::size_t(n));
    const glm::ivec3 low =
        tileEdge * glm::ivec3(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y);
    if (!brick.voxels && !brick.label) continue;
    const glm::ivec3 high = glm::min(low + tileEdge, grid) - 1;
    if (!brick.voxels && !within) {
      add(brick.label, low, high);
      continue;
    }
    for (int v = 0; v < tileVoxels; ++v) {
      const glm::ivec3 at = low + glm::ivec3(v % tileEdge, v / tileEdge % tileEdge, v / tileStride[2]);
      const std::uint8_t label = brick.voxels ? (*brick.voxels)[std::size_t(v)] : brick.label;
      if (label && glm::all(glm::lessThanEqual(at, high)) && (!within || within->at(at))) add(label, at, at);
    }
  }
  found.labels = int(std::count(there.begin() + 1, there.end(), true));
  return found;
}

VoxelBox withMargin(const VoxelBox& seeds, const VoxelGeometry& geometry, double marginMm) {
  const glm::dvec3 voxels = std::max(marginMm, 0.0) / geometry.spacing();
  const glm::ivec3 reach = glm::min(voxels, glm::dvec3(geometry.size));
  return {glm::max(seeds.low - reach, glm::ivec3(0)), glm::min(seeds.high + reach, geometry.size - 1)};
}

// Values as whole steps: the range (P0.1 to P99.9) in the middle, and 1.5 of it on both sides.
struct SeedLevels {
  double low, perValue;

  explicit SeedLevels(const Volume& volume) {
    const std::vector<float> at = percentiles(volume, {1, 999});
    ValueRange range{at[0], at[1]};
    if (range.low == range.high) range = valueRange(volume);
    low = range.low;
    perValue = range.low == range.high ? 0 : costsOfRange / (range.high - range.low);
  }
  std::uint16_t of(float value) const {
    const double level = (double(value) - low) * perValue + 1.5 * costsOfRange;
    return std::uint16_t(std::clamp(level, 0.0, 65535.0) + 0.5);
  }
};

// A voxel that was reached and has not told its neighbours.
struct GrowthPending {
  Cost cost;
  std::uint16_t voxel;
};

// What a voxel of another tile is told.
struct GrowthMessage {
  Cost cost;
  std::uint16_t voxel;
  std::uint8_t label;
};

// The voxels of a brick. Those that are not to be reached cost nothing: nothing is cheaper.
struct GrowthTile {
  std::array<Cost, tileVoxels> cost;
  std::array<std::uint16_t, tileVoxels> level;
  LabelMap::Voxels label;
  std::vector<GrowthPending> pending;
  Cost earliest = unreached;                      // of `pending`, or before it
  int reached = 0;                                // voxels
  std::array<std::vector<GrowthMessage>, 6> out;  // to the tiles before and behind it, along i, j, k

  bool improve(int voxel, Cost by, std::uint8_t from) {
    if (by > cost[std::size_t(voxel)] ||
        (by == cost[std::size_t(voxel)] && from >= label[std::size_t(voxel)]))
      return false;
    reached += cost[std::size_t(voxel)] == unreached;
    cost[std::size_t(voxel)] = by;
    label[std::size_t(voxel)] = from;
    return true;
  }
  void wait(int voxel, Cost at) {
    pending.push_back({at, std::uint16_t(voxel)});
    earliest = std::min(earliest, at);
  }
};

// Shortest paths tile by tile. Costs and labels of voxels are only ever bettered, until nothing can be: what
// that ends in is one, in whatever order tiles are taken.
class Growth {
 public:
  Growth(const Volume& volume, const LabelMap& seeds, const VoxelBox& box, const SeedGrowth& growth,
         const CancelToken& cancel)
      : volume_(volume),
        seeds_(seeds),
        box_(box),
        within_(growth.within),
        bricks_(seeds.bricks()),
        cancel_(cancel) {
    const glm::dvec3 spacing = volume.geometry().spacing();
    for (int a = 0; a < 3; ++a)
      step_[a] = int(std::lround(std::clamp(growth.locality * costsOfRange * spacing[a], 0.0, mostPerStep)));
    tiles_.resize(std::size_t(bricks_.x) * std::size_t(bricks_.y) * std::size_t(bricks_.z));
    const SeedLevels levels(volume);
    overTiles([&](std::size_t n) { make(n, levels); });
  }

  void run() {
    const glm::dvec3 size(box_.high - box_.low + 1);
    const double voxels = size.x * size.y * size.z;
    for (;;) {
      Cost earliest = unreached;
      double reached = 0;
      for (const auto& tile : tiles_)
        if (tile) earliest = std::min(earliest, tile->earliest), reached += tile->reached;
      cancel_.setDone(reached / voxels);
      if (earliest == unreached || cancel_.cancelled()) return;
      std::vector<std::size_t> open;
      for (std::size_t n = 0; n < tiles_.size(); ++n)
        if (tiles_[n] && tiles_[n]->earliest - earliest < windowCosts) open.push_back(n);
      parallelFor(std::int64_t(open.size()), 0, [&](std::int64_t begin, std::int64_t end) {
        BucketQueue queue(windowCosts);
        for (std::int64_t n = begin; n < end && !cancel_.cancelled(); ++n)
          follow(open[std::size_t(n)], earliest, queue);
      });
      overTiles([&](std::size_t n) { hear(n); });
    }
  }

  DenseLabels labels() const {
    DenseLabels all = seeds_.dense();
    overTiles([&](std::size_t n) {
      if (!tiles_[n]) return;
      const VoxelBox part = partOf(n);
      const glm::ivec3 corner = cornerOf(n);
      for (int k = part.low.z; k <= part.high.z; ++k)
        for (int j = part.low.y; j <= part.high.y; ++j)
          std::copy_n(tiles_[n]->label.data() + placeOf(glm::ivec3(part.low.x, j, k) - corner),
                      part.high.x - part.low.x + 1, all.labels.data() + rowOf(j, k) + part.low.x);
    });
    return all;
  }

 private:
  template <class Work>
  void overTiles(const Work& work) const {
    parallelFor(std::int64_t(tiles_.size()), 0, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t n = begin; n < end && !cancel_.cancelled(); ++n) work(std::size_t(n));
    });
  }
  glm::ivec3 cornerOf(std::size_t tile) const {
    const int n = int(tile);
    return tileEdge * glm::ivec3(n % bricks_.x, n / bricks_.x % bricks_.y, n / bricks_.x / bricks_.y);
  }
  // What of the box lies in a tile.
  VoxelBox partOf(std::size_t tile) const {
    const glm::ivec3 corner = cornerOf(tile);
    return {glm::max(corner, box_.low), glm::min(corner + tileEdge - 1, box_.high)};
  }
  static int placeOf(glm::ivec3 inTile) {
    return inTile.x + tileStride[1] * inTile.y + tileStride[2] * inTile.z;
  }
  std::int64_t rowOf(int j, int k) const {
    return (std::int64_t(k) * volume_.size().y + j) * volume_.size().x;
  }

  void make(std::size_t n, const SeedLevels& levels);
  void follow(std::size_t n, Cost from, BucketQueue& queue);
  void hear(std::size_t n);
  // The tile before (side 0) or behind (1) another along an axis; null where there is none.
  GrowthTile* neighbour(std::size_t n, int axis, int side) const {
    const std::ptrdiff_t stride = axis == 0   ? 1
                                  : axis == 1 ? bricks_.x
                                              : std::ptrdiff_t(bricks_.x) * bricks_.y;
    const int at = cornerOf(n)[axis] / tileEdge + (side ? 1 : -1);
    if (at < 0 || at >= bricks_[axis]) return nullptr;
    return tiles_[std::size_t(std::ptrdiff_t(n) + (side ? stride : -stride))].get();
  }

  const Volume& volume_;
  const LabelMap& seeds_;
  const VoxelBox box_;
  const BitMask* const within_;  // null: all
  const glm::ivec3 bricks_;
  const CancelToken& cancel_;
  glm::ivec3 step_{0};  // what a step along each axis costs by its length
  std::vector<std::unique_ptr<GrowthTile>> tiles_;
};

void Growth::make(std::size_t n, const SeedLevels& levels) {
  const VoxelBox part = partOf(n);
  if (part.low.x > part.high.x || part.low.y > part.high.y || part.low.z > part.high.z) return;
  tiles_[n] = std::make_unique_for_overwrite<GrowthTile>();
  GrowthTile& tile = *tiles_[n];
  tile.cost.fill(0);
  tile.level.fill(0);
  tile.label.fill(0);
  const LabelMap::Brick& brick = seeds_.brick(n);
  const glm::ivec3 corner = cornerOf(n);
  std::visit(
      [&](const auto& stored) {
        for (int k = part.low.z; k <= part.high.z; ++k)
          for (int j = part.low.y; j <= part.high.y; ++j)
            for (int i = part.low.x; i <= part.high.x; ++i) {
              const int voxel = placeOf(glm::ivec3(i, j, k) - corner);
              const auto at = std::size_t(voxel);
              tile.level[at] = levels.of(volume_.realValue(double(stored[std::size_t(rowOf(j, k) + i)])));
              tile.label[at] = brick.voxels ? (*brick.voxels)[at] : brick.label;
              if (within_ && !within_->at({i, j, k})) continue;
              if (tile.label[at])
                tile.wait(voxel, 0);
              else
                tile.cost[at] = unreached;
            }
      },
      volume_.stored());
}

// Follows all paths of a tile through costs of from .. from + windowCosts - 1.
void Growth::follow(std::size_t n, Cost from, BucketQueue& queue) {
  GrowthTile& tile = *tiles_[n];
  std::array<GrowthTile*, 6> beside{};
  for (int d = 0; d < 6; ++d) beside[std::size_t(d)] = neighbour(n, d / 2, d % 2);
  std::vector<GrowthPending> pending;
  pending.swap(tile.pending);
  tile.earliest = unreached;
  for (const GrowthPending& one : pending) {
    if (tile.cost[one.voxel] != one.cost) continue;  // it has been reached cheaper since
    if (one.cost - from < windowCosts)
      queue.push(one.cost - from, one.voxel);
    else
      tile.wait(one.voxel, one.cost);
  }
  for (Cost bucket = 0; bucket < windowCosts; ++bucket)
    for (int voxel = queue.pop(bucket); voxel >= 0; voxel = queue.pop(bucket)) {
      const auto at = std::size_t(voxel);
      if (tile.cost[at] != from + bucket) continue;
      const int level = tile.level[at];
      const std::uint8_t label = tile.label[at];
      // Along each axis, before and behind; d counts as in GrowthTile::out.
      const auto tell = [&]<int d>(std::integral_constant<int, d>) {
        constexpr int stride = tileStride[d / 2], toNext = d % 2 ? stride : -stride;
        const bool leaves = voxel / stride % tileEdge == (d % 2 ? tileEdge - 1 : 0);
        const int next = leaves ? voxel - (tileEdge - 1) * toNext : voxel + toNext;
        GrowthTile* const to = leaves ? beside[d] : &tile;
        if (!to) return;
        const int difference = std::abs(level - int(to->level[std::size_t(next)]));
        const Cost cost = from + bucket + Cost(std::max(1, difference + step_[d / 2]));
        if (leaves)
          tile.out[d].push_back({cost, std::uint16_t(next), label});
        else if (tile.improve(next, cost, label)) {
          if (cost - from < windowCosts)
            queue.push(cost - from, next);
          else
            tile.wait(next, cost);
        }
      };
      tell(std::integral_constant<int, 0>()), tell(std::integral_constant<int, 1>());
      tell(std::integral_constant<int, 2>()), tell(std::integral_constant<int, 3>());
      tell(std::integral_constant<int, 4>()), tell(std::integral_constant<int, 5>());
    }
  queue.clear();
}

// Takes in what neighbours have told a tile.
void Growth::hear(std::size_t n) {
  if (!tiles_[n]) return;
  GrowthTile& tile = *tiles_[n];
  for (int d = 0; d < 6; ++d) {
    GrowthTile* const from = neighbour(n, d / 2, d % 2);
    if (!from) continue;
    auto& told = from->out[std::size_t(d ^ 1)];
    for (const GrowthMessage& one : told)
      if (tile.improve(one.voxel, one.cost, one.label)) tile.wait(one.voxel, one.cost);
    told.clear();
  }
}

}  // namespace

Result<LabelMap> grownFromSeeds(const Volume& volume, const LabelMap& seeds, const SeedGrowth& growth,
                                const CancelToken& cancel) try {
  const SeedsFound found = findSeeds(seeds, growth.within);
  if (found.labels < 2)
    return Error{"seeds of at least two segments are needed: what lies around is one of them, too"};
  Growth grown(volume, seeds, withMargin(found.box, volume.geometry(), growth.marginMm), growth, cancel);
  grown.run();
  LabelMap labels(grown.labels());
  if (cancel.cancelled()) return Error{"it was cancelled"};
  return labels;
} catch (const std::bad_alloc&) {
  return Error{"there is not enough memory: grow within a smaller margin"};
}

double marginAboutSeeds(const BitMask& seeds) {
  constexpr double share = 0.1, leastVoxels = 3;
  const auto box = seeds.box();
  if (!box) return 0;
  const glm::dvec3 spacing = seeds.geometry().spacing(),
                   edges = glm::dvec3(box->high - box->low + 1) * spacing;
  return std::max(share * std::max({edges.x, edges.y, edges.z}),
                  leastVoxels * std::max({spacing.x, spacing.y, spacing.z}));
}

}  // namespace volumen
