#pragma once

#include "ui/controller/draw.h"

namespace volumen {

/// Shares the precomputed data of volumes among everything that draws them, as long as something else holds
/// the volume. For one thread.
class VoxelPool {
 public:
  /// Returns the data of this volume; makes it if there is none.
  VoxelsPtr voxelsOf(const VolumePtr& volume);
  /// Drops the data of volumes that nothing else holds.
  void dropUnheld();
  /// Returns whether some data are held by nothing else, even if their volume is.
  bool hasIdle() const;

 private:
  std::vector<VoxelsPtr> all_;
};

}  // namespace volumen
