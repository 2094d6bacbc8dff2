#pragma once

#include "ui/controller/draw.h"

namespace volumen {

/// What was computed once of volumes, for all that draw them: kept as long as somebody else holds the volume.
/// For one thread.
class VoxelPool {
 public:
  /// Those of this volume, made where there are none yet.
  VoxelsPtr voxelsOf(const VolumePtr& volume);
  /// Forgets those of volumes that nobody else holds.
  void dropUnheld();
  /// Whether some are held by nobody else, only their volume.
  bool hasIdle() const;

 private:
  std::vector<VoxelsPtr> all_;
};

}  // namespace volumen
