#include "viewer/segment/lesion.h"

#include "viewer/segment/numbers.h"
#include "viewer/segment/parts.h"

namespace volumen {

namespace {

// Returns the region's voxels with a value of at least `least`. The cost grows with the region, not with the
// grid.
BitMask fromValueOn(const BitMask& region, const Volume& volume, double least) {
  const std::optional<ValueRange>& padding = volume.attributes().padding;
  BitMask found(region.geometry());
  for (const glm::ivec3& v : voxelsOf(region)) {
    const double value = double(volume.value(v.x, v.y, v.z));
    if (value >= least && !isPadding(padding, value)) found.set(v);
  }
  return found;
}

bool reachesOut(const BitMask& mask, const BitMask& of) {
  for (const glm::ivec3& voxel : voxelsOf(mask))
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        glm::ivec3 beside = voxel;
        beside[axis] += step;
        if (beside[axis] >= 0 && beside[axis] < mask.size()[axis] && !of.at(beside)) return true;
      }
  return false;
}

}  // namespace

Result<BitMask> lesionIn(const BitMask& region, const Volume& volume, LesionThreshold threshold,
                         const CancelToken& cancel) {
  const SegmentValues values = valuesIn(region, volume);
  if (values.voxels == 0) return Error{"no voxel of the region has a value"};
  const double least = double(float(threshold.isShare ? threshold.amount * values.max : threshold.amount));
  if (values.max < least) return Error{"no value of the region reaches the threshold"};
  const glm::ivec3 at[] = {values.maxAt};
  BitMask found = connected(fromValueOn(region, volume, least), at, Neighbours::faces, cancel);
  if (cancel.cancelled()) return Error{"cancelled"};
  if (reachesOut(found, region))
    return Error{
        "what is found reaches the border of the region: choose a larger one or a higher threshold, or "
        "keep other uptake out of it"};
  return found;
}

}  // namespace volumen
