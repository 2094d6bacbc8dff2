#pragma once

#include <QByteArray>
#include <map>
#include <memory>
#include <vector>

#include "viewer/segment/label_map.h"

namespace volumen {

/// A brick of labels, compressed.
struct PackedBrick {
  std::weak_ptr<const LabelMap::Voxels> voxels;  ///< its voxels while somebody holds them
  QByteArray bytes;
};

/// A label map in little memory. Not thread-safe.
class PackedLabels {
 public:
  /// Returns the map. It is the very map, with the very bricks, that others still hold.
  std::shared_ptr<const LabelMap> labels();
  /// Bricks with more than one label, the others null.
  const std::vector<std::shared_ptr<PackedBrick>>& bricks() const { return bricks_; }

 private:
  friend class LabelPacker;
  explicit PackedLabels(const VoxelGeometry& geometry) : geometry_(geometry) {}

  VoxelGeometry geometry_;
  std::weak_ptr<const LabelMap> held_;
  std::vector<std::uint8_t> uniform_;  // by brick
  std::vector<std::shared_ptr<PackedBrick>> bricks_;
};

/// Packs label maps. Maps that share bricks share them packed, too.
class LabelPacker {
 public:
  std::shared_ptr<PackedLabels> packed(const std::shared_ptr<const LabelMap>& labels);

 private:
  std::shared_ptr<PackedBrick> packed(const std::shared_ptr<const LabelMap::Voxels>& voxels);

  // By address, which another one may have taken meanwhile.
  std::map<const LabelMap*, std::weak_ptr<PackedLabels>> maps_;
  std::map<const LabelMap::Voxels*, std::weak_ptr<PackedBrick>> bricks_;
};

}  // namespace volumen
