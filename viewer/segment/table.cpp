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

// Dilates by `reach` voxels along one axis.
BitMask grownAlong(const BitMask& mask, int axis, int reach, const CancelToken& cancel) {
  const int most = std::min(reach, mask.size()[axis] - 1);
  std::vector<SpreadRow> rows;
  if (axis == 0)
    rows.push_back({0, 0, -most, most});
  else
    for (int n = -most; n <= most; ++n) rows.push_back({axis == 1 ? n : 0, axis == 2 ? n : 0, 0, 0});
  return spread(mask, rows, cancel);
}

BitMask notAirIn(const Volume& volume) {
  return voxelsInRange(volume, {notAirHu, std::numeric_limits<double>::infinity()});
}

// Dilates by a box that reaches `mm` to each side.
BitMask grownByBox(BitMask mask, double mm, const CancelToken& cancel) {
  const glm::dvec3 spacing = mask.geometry().spacing();
  for (int axis = 0; axis < 3 && !cancel.cancelled(); ++axis)
    mask = grownAlong(mask, axis, int(std::lround(std::min(mm / spacing[axis], 1e6))), cancel);
  return mask;
}

// Fills the holes in each slice and grows the mask by the skin margin.
BitMask filledAndGrown(BitMask mask, const CancelToken& cancel) {
  if (cancel.cancelled() || mask.empty()) return mask;
  mask = holesFilledInSlices(mask, axisAlongPatient(mask.geometry()), cancel);
  return grownByBox(std::move(mask), grownMm, cancel);
}

// Returns whether a further component belongs to the patient: it is large and somewhere thicker than a
// table's shell.
bool staysBeside(const Parts& parts, std::size_t n, const CancelToken& cancel) {
  constexpr double largePart = 0.1, shellMm = 8;
  if (double(parts.size(n)) < largePart * double(parts.size(0))) return false;
  std::vector<bool> alone(parts.count());
  alone[n] = true;
  return !inverted(grownByBox(inverted(parts.mask(alone)), shellMm / 2, cancel)).empty();
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
  return filledAndGrown(Parts(notAirIn(volume), Neighbours::faces, cancel).largest(), cancel);
}

std::optional<BitMask> patientBesideTable(const Volume& volume, const CancelToken& cancel) {
  constexpr double leastTable = 0.005;  // share of voxels above notAirHu; a chest CT's is ten times that
  const BitMask notAir = notAirIn(volume);
  const Parts parts(notAir, Neighbours::faces, cancel);
  if (parts.count() < 2) return {};
  std::vector<bool> stays(parts.count());
  for (std::size_t n = 0; n < parts.count(); ++n) stays[n] = n == 0 || staysBeside(parts, n, cancel);
  BitMask patient = filledAndGrown(parts.mask(stays), cancel);
  const std::int64_t leftOut = subtracted(notAir, patient).count();
  return double(leftOut) < leastTable * double(notAir.count()) ? std::nullopt
                                                               : std::optional(std::move(patient));
}

}  // namespace volumen
