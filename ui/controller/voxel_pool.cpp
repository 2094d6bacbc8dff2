#include "ui/controller/voxel_pool.h"

#include <algorithm>

namespace volumen {

namespace {

bool isIdle(const VoxelsPtr& voxels) { return voxels.use_count() == 1; }

}  // namespace

VoxelsPtr VoxelPool::voxelsOf(const VolumePtr& volume) {
  const auto known =
      std::find_if(all_.begin(), all_.end(), [&](const VoxelsPtr& v) { return v->volume() == volume; });
  if (known != all_.end()) return *known;
  return all_.emplace_back(std::make_shared<StoredVoxels>(volume));
}

void VoxelPool::dropUnheld() {
  std::erase_if(all_, [](const VoxelsPtr& v) { return isIdle(v) && v->volume().use_count() == 1; });
}

bool VoxelPool::hasIdle() const { return std::any_of(all_.begin(), all_.end(), isIdle); }

}  // namespace volumen
