#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "viewer/segment/grow_from_seeds.h"
#include "viewer/segment/label_map.h"
#include "viewer/volume/histogram.h"
#include "viewer/volume/volume.h"

namespace volumen {

using GrowthCost = std::uint32_t;

/// Values as whole steps: the range (P0.1 to P99.9) in the middle, and 1.5 of it on both sides.
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

/// A voxel that was reached and has not told its neighbours.
struct GrowthPending {
  GrowthCost cost;
  std::uint16_t voxel;
};

/// What a voxel of another tile is told.
struct GrowthMessage {
  GrowthCost cost;
  std::uint16_t voxel;
  std::uint8_t label;
};

/// The voxels of a brick. Those that are not to be reached cost nothing: nothing is cheaper.
struct GrowthTile {
  static constexpr GrowthCost unreached = std::numeric_limits<GrowthCost>::max();
  static constexpr int voxels = LabelMap::edge * LabelMap::edge * LabelMap::edge;

  std::array<GrowthCost, voxels> cost;
  std::array<std::uint16_t, voxels> level;
  LabelMap::Voxels label;
  std::vector<GrowthPending> pending;
  GrowthCost earliest = unreached;                ///< of `pending`, or before it
  GrowthCost dearest = unreached;                 ///< no voxel costs more, once all are reached
  int reached = 0, open = 0;                      ///< voxels; that may be reached
  std::array<std::vector<GrowthMessage>, 6> out;  ///< to the tiles before and behind it, along i, j, k

  bool improve(int voxel, GrowthCost by, std::uint8_t from) {
    if (by > cost[std::size_t(voxel)] ||
        (by == cost[std::size_t(voxel)] && from >= label[std::size_t(voxel)]))
      return false;
    reached += cost[std::size_t(voxel)] == unreached;
    cost[std::size_t(voxel)] = by;
    label[std::size_t(voxel)] = from;
    return true;
  }
  void wait(int voxel, GrowthCost at) {
    pending.push_back({at, std::uint16_t(voxel)});
    earliest = std::min(earliest, at);
  }
};

}  // namespace volumen
