#include "viewer/segment/table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "viewer/segment/holes.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/range.h"
#include "viewer/segment/spread.h"

namespace volumen {

namespace {

constexpr double grownMm = 3;

// What lies within `reach` voxels along one axis too.
BitMask grownAlong(const BitMask& mask, int axis, int reach, const CancelToken& cancel) {
  const int most = std::min(reach, mask.size()[axis] - 1);
  std::vector<SpreadRow> rows;
  if (axis == 0)
    rows.push_back({0, 0, -most, most});
  else
    for (int n = -most; n <= most; ++n) rows.push_back({axis == 1 ? n : 0, axis == 2 ? n : 0, 0, 0});
  return spread(mask, rows, cancel);
}

}  // namespace

int axisAlongPatient(const VoxelGeometry& geometry) {
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const glm::dvec3 spacing = geometry.spacing();
  int axis = 2;
  for (int a = 1; a >= 0; --a)
    if (std::abs(step[a].z) / spacing[a] > std::abs(step[axis].z) / spacing[axis]) axis = a;
  return axis;
}

BitMask patientMask(const Volume& volume, const CancelToken& cancel) {
  const BitMask notAir = voxelsInRange(volume, {notAirHu, std::numeric_limits<double>::infinity()});
  BitMask mask = Parts(notAir, Neighbours::faces, cancel).largest();
  if (cancel.cancelled() || mask.empty()) return mask;
  mask = holesFilledInSlices(mask, axisAlongPatient(mask.geometry()), cancel);
  const glm::dvec3 spacing = mask.geometry().spacing();
  for (int axis = 0; axis < 3 && !cancel.cancelled(); ++axis)
    mask = grownAlong(mask, axis, int(std::lround(std::min(grownMm / spacing[axis], 1e6))), cancel);
  return mask;
}

}  // namespace volumen
