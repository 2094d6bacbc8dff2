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

/// Maps values to 16-bit integer levels: the range (P0.1 to P99.9) in the middle, with 1.5 ranges on either
/// side.
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

/// A reached voxel that has not updated its neighbours yet.
struct GrowthPending {
  GrowthCost cost;
  std::uint16_t voxel;
};

/// An update for a voxel of a neighbouring tile.
struct GrowthMessage {
  GrowthCost cost;
  std::uint16_t voxel;
  std::uint8_t label;
};

/// The voxels of one brick. Voxels that must not be reached have cost 0, so that no path improves them.
struct GrowthTile {
  static constexpr GrowthCost unreached = std::numeric_limits<GrowthCost>::max();
  static constexpr int voxels = LabelMap::edge * LabelMap::edge * LabelMap::edge;

  std::array<GrowthCost, voxels> cost;
  std::array<std::uint16_t, voxels> level;
  LabelMap::Voxels label;
  std::vector<GrowthPending> pending;
  GrowthCost earliest = unreached;  ///< Lower bound of the costs in `pending`
  GrowthCost dearest = unreached;   ///< Largest cost of a voxel once all are reached
  int reached = 0, open = 0;        ///< Voxels reached; voxels that may be reached
  /// Updates for the tiles before and behind this one, along i, j, k.
  std::array<std::vector<GrowthMessage>, 6> out;

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
