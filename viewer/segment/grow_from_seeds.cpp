#include "viewer/segment/grow_from_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "viewer/segment/bucket_queue.h"
#include "viewer/segment/growth_tile.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using Cost = GrowthCost;
constexpr Cost unreached = GrowthTile::unreached;
constexpr double mostPerStep = 1 << 19;  // limit that keeps every path from overflowing

constexpr int tileEdge = LabelMap::edge;
constexpr int tileVoxels = GrowthTile::voxels;
constexpr std::array<int, 3> tileStride = {1, tileEdge, tileEdge* tileEdge};

// Cost window in which tiles follow paths before they exchange updates, in costs of the value range.
constexpr Cost windowCosts = 2048;

// Number of seed labels and their bounding box.
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

// Shortest paths, tile by tile. Costs and labels only ever improve until none can, so the result does not
// depend on the order of tiles.
class Growth {
 public:
  Growth(const Volume& volume, const LabelMap& seeds, const VoxelBox& box, const SeedGrowth& growth,
         const CancelToken& cancel)
      : volume_(volume),
        seeds_(seeds),
        box_(box),
        within_(growth.within),
        bricks_(seeds.bricks()),
        levels_(volume),
        labels_(seeds.dense()),
        cancel_(cancel) {
    const glm::dvec3 spacing = volume.geometry().spacing();
    for (int a = 0; a < 3; ++a)
      step_[a] = int(std::lround(std::clamp(growth.locality * costsOfRange * spacing[a], 0.0, mostPerStep)));
    tiles_.resize(std::size_t(bricks_.x) * std::size_t(bricks_.y) * std::size_t(bricks_.z));
    isFinal_.resize(tiles_.size());
    overTiles([&](std::size_t n) {
      if (seeds_.brick(n).label || seeds_.brick(n).voxels) make(n);
    });
  }

  void run() {
    const glm::dvec3 size(box_.high - box_.low + 1);
    const double voxels = size.x * size.y * size.z;
    double ofFinal = 0;
    for (;;) {
      Cost earliest = unreached;
      double reached = ofFinal;
      for (const auto& tile : tiles_)
        if (tile) earliest = std::min(earliest, tile->earliest), reached += tile->reached;
      cancel_.setDone(reached / voxels);
      ofFinal += finish(earliest);
      if (earliest == unreached || cancel_.cancelled()) return;
      std::vector<std::size_t> open;
      for (std::size_t n = 0; n < tiles_.size(); ++n)
        if (tiles_[n] && tiles_[n]->earliest - earliest < windowCosts) open.push_back(n);
      parallelFor(std::int64_t(open.size()), 0, [&](std::int64_t begin, std::int64_t end) {
        BucketQueue queue(windowCosts);
        for (std::int64_t n = begin; n < end && !cancel_.cancelled(); ++n)
          follow(open[std::size_t(n)], earliest, queue);
      });
      makeReached();
      overTiles([&](std::size_t n) { hear(n); });
    }
  }

  DenseLabels labels() { return std::move(labels_); }

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
  // Returns the part of the box that lies in a tile.
  VoxelBox partOf(std::size_t tile) const {
    const glm::ivec3 corner = cornerOf(tile);
    return {glm::max(corner, box_.low), glm::min(corner + tileEdge - 1, box_.high)};
  }
  static glm::ivec3 placeIn(int voxel) {
    return {voxel % tileEdge, voxel / tileEdge % tileEdge, voxel / tileStride[2]};
  }
  static int placeOf(glm::ivec3 inTile) {
    return inTile.x + tileStride[1] * inTile.y + tileStride[2] * inTile.z;
  }
  std::int64_t rowOf(int j, int k) const {
    return (std::int64_t(k) * volume_.size().y + j) * volume_.size().x;
  }

  void make(std::size_t n);
  void makeReached();
  double finish(Cost earliest);
  void takeLabels(std::size_t n);
  int levelAt(glm::ivec3 voxel) const;
  void follow(std::size_t n, Cost from, BucketQueue& queue);
  void hear(std::size_t n);
  // Returns the tile before (side 0) or behind (1) another along an axis; empty at the end of the grid.
  std::optional<std::size_t> beside(std::size_t n, int axis, int side) const {
    const std::ptrdiff_t stride = axis == 0   ? 1
                                  : axis == 1 ? bricks_.x
                                              : std::ptrdiff_t(bricks_.x) * bricks_.y;
    const int at = cornerOf(n)[axis] / tileEdge + (side ? 1 : -1);
    if (at < 0 || at >= bricks_[axis]) return {};
    return std::size_t(std::ptrdiff_t(n) + (side ? stride : -stride));
  }
  // Returns the updates from that neighbour for this tile; null if there is no such tile.
  std::vector<GrowthMessage>* toldBy(std::size_t n, int d) const {
    const auto from = beside(n, d / 2, d % 2);
    return from && tiles_[*from] ? &tiles_[*from]->out[std::size_t(d ^ 1)] : nullptr;
  }

  const Volume& volume_;
  const LabelMap& seeds_;
  const VoxelBox box_;
  const BitMask* const within_;  // null means all voxels
  const glm::ivec3 bricks_;
  const SeedLevels levels_;
  DenseLabels labels_;
  const CancelToken& cancel_;
  glm::ivec3 step_{0};  // cost of a step along each axis by its length
  // Tiles that paths have reached; null before that and once they are final.
  std::vector<std::unique_ptr<GrowthTile>> tiles_;
  std::vector<char> isFinal_;
};

int Growth::levelAt(glm::ivec3 voxel) const { return levels_.of(volume_.value(voxel.x, voxel.y, voxel.z)); }

void Growth::make(std::size_t n) {
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
              tile.level[at] = levels_.of(volume_.realValue(double(stored[std::size_t(rowOf(j, k) + i)])));
              tile.label[at] = brick.voxels ? (*brick.voxels)[at] : brick.label;
              if (within_ && !within_->at({i, j, k})) continue;
              if (tile.label[at])
                tile.wait(voxel, 0);
              else
                tile.cost[at] = unreached, ++tile.open;
            }
      },
      volume_.stored());
}

// Creates the tiles that receive updates for the first time.
void Growth::makeReached() {
  std::vector<std::size_t> reached;
  for (std::size_t n = 0; n < tiles_.size(); ++n)
    for (int d = 0; d < 6 && !tiles_[n]; ++d)
      if (const auto* told = toldBy(n, d); told && !told->empty()) {
        reached.push_back(n);
        break;
      }
  parallelFor(std::int64_t(reached.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) make(reached[std::size_t(n)]);
  });
}

void Growth::takeLabels(std::size_t n) {
  const VoxelBox part = partOf(n);
  const glm::ivec3 corner = cornerOf(n);
  for (int k = part.low.z; k <= part.high.z; ++k)
    for (int j = part.low.y; j <= part.high.y; ++j)
      std::copy_n(tiles_[n]->label.data() + placeOf(glm::ivec3(part.low.x, j, k) - corner),
                  part.high.x - part.low.x + 1, labels_.labels.data() + rowOf(j, k) + part.low.x);
}

// Finalizes tiles in which no voxel can get cheaper, because open paths cost at least `earliest`: takes their
// labels and frees them. Returns the number of voxels reached in them.
double Growth::finish(Cost earliest) {
  overTiles([&](std::size_t n) {
    if (!tiles_[n]) return;
    GrowthTile& tile = *tiles_[n];
    if (earliest != unreached) {
      if (!tile.pending.empty() || tile.reached < tile.open) return;
      if (tile.dearest == unreached) tile.dearest = *std::ranges::max_element(tile.cost);
      if (tile.dearest > earliest) return;
    }
    takeLabels(n);
    isFinal_[n] = true;
  });
  double reached = 0;
  for (std::size_t n = 0; n < tiles_.size(); ++n)
    if (tiles_[n] && isFinal_[n]) {
      reached += tiles_[n]->reached;
      tiles_[n].reset();
    }
  return reached;
}

// Follows all paths of a tile with costs from .. from + windowCosts - 1.
void Growth::follow(std::size_t n, Cost from, BucketQueue& queue) {
  GrowthTile& tile = *tiles_[n];
  const VoxelBox part = partOf(n);
  const glm::ivec3 corner = cornerOf(n);
  std::array<bool, 6> goesOn{};  // true if paths may continue into that neighbour
  for (int d = 0; d < 6; ++d) {
    const auto next = beside(n, d / 2, d % 2);
    const int end = d % 2 ? part.high[d / 2] + 1 : part.low[d / 2] - 1;
    goesOn[std::size_t(d)] = next && !isFinal_[*next] && end >= box_.low[d / 2] && end <= box_.high[d / 2];
  }
  std::vector<GrowthPending> pending;
  pending.swap(tile.pending);
  tile.earliest = unreached;
  for (const GrowthPending& one : pending) {
    if (tile.cost[one.voxel] != one.cost) continue;  // a cheaper path has reached it since
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
      // Updates the neighbour in direction d, counted as in GrowthTile::out.
      const auto tell = [&]<int d>(std::integral_constant<int, d>) {
        constexpr int stride = tileStride[d / 2], toNext = d % 2 ? stride : -stride;
        const bool leaves = voxel / stride % tileEdge == (d % 2 ? tileEdge - 1 : 0);
        if (leaves && !goesOn[d]) return;
        const int next = leaves ? voxel - (tileEdge - 1) * toNext : voxel + toNext;
        int levelThere = 0;
        if (leaves) {
          glm::ivec3 there = corner + placeIn(voxel);
          there[d / 2] += d % 2 ? 1 : -1;
          levelThere = levelAt(there);
        } else {
          levelThere = tile.level[std::size_t(next)];
        }
        const int difference = std::abs(level - levelThere);
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

// Applies the updates from neighbouring tiles.
void Growth::hear(std::size_t n) {
  if (!tiles_[n]) return;
  GrowthTile& tile = *tiles_[n];
  for (int d = 0; d < 6; ++d) {
    auto* const told = toldBy(n, d);
    if (!told) continue;
    for (const GrowthMessage& one : *told)
      if (tile.improve(one.voxel, one.cost, one.label)) tile.wait(one.voxel, one.cost);
    told->clear();
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
