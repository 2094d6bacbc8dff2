#include "viewer/segment/mask.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "viewer/segment/bit_rows.h"
#include "viewer/segment/closed_outline.h"
#include "viewer/segment/range.h"
#include "viewer/segment/table.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double air = -1000;
constexpr double depthRounding = 1e-9;  // mm

// Calls cut(i, j, k) for each voxel with isThere(i, j, k) that the lasso cuts away. Rows run in parallel,
// voxels of a row in order.
template <class IsThere, class Cut>
void cutAway(const VoxelGeometry& geometry, const Lasso& lasso, const IsThere& isThere, const Cut& cut,
             const CancelToken& cancel) {
  const ClosedOutline outline(lasso.points);
  const glm::dvec3 forward = lasso.forward();
  const auto cutsAway = [&](glm::dvec3 pPatient) {
    const glm::dvec3 d = pPatient - lasso.origin;
    glm::dvec2 p(glm::dot(d, lasso.right), glm::dot(d, lasso.down));
    const double depth = lasso.perspective ? glm::dot(d, forward) : 1;
    return (depth > 0 && outline.holds(p / depth)) == lasso.inside;
  };
  const glm::ivec3 size = geometry.size;
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end && !cancel.cancelled(); ++row) {
      const int j = int(row % size.y), k = int(row / size.y);
      for (int i = 0; i < size.x; ++i)
        if (isThere(i, j, k) && cutsAway(geometry.patientFromVoxel({i, j, k}))) cut(i, j, k);
    }
  });
}

void cutAll(BitMask& kept, const Mask& mask, const CancelToken& cancel) {
  for (const auto& lasso : mask.lassos)
    cutAway(
        kept.geometry(), *lasso,
        [&](int i, int j, int k) {
          return kept.at({i, j, k});
        },
        [&](int i, int j, int k) {
          kept.set({i, j, k}, false);
        },
        cancel);
}

template <class T>
void cutAll(std::vector<T>& values, T empty, const VoxelGeometry& geometry,
            std::span<const std::shared_ptr<const Lasso>> lassos, const CancelToken& cancel) {
  const auto value = [&](int i, int j, int k) -> T& {
    return values[std::size_t(i) + std::size_t(geometry.size.x) *
                                       (std::size_t(j) + std::size_t(geometry.size.y) * std::size_t(k))];
  };
  for (const auto& lasso : lassos)
    cutAway(
        geometry, *lasso, [&](int i, int j, int k) { return value(i, j, k) != empty; },
        [&](int i, int j, int k) { value(i, j, k) = empty; }, cancel);
}

BitMask beforeLassos(const Volume& volume, const Mask& mask, const CancelToken& cancel) {
  if (mask.tableRemoved) return patientMask(volume, cancel);
  return inverted(BitMask(volume.geometry()));
}

// Returns the stored value closest to `value`, clamped to the values that occur in the volume.
template <class T>
T storedNear(double value, const Volume& volume, const std::vector<T>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double stored = (value - volume.intercept()) / volume.slope();
  const double within = std::clamp(stored, double(*low), double(*high));
  return std::is_floating_point_v<T> ? T(within) : T(std::lround(within));
}

VoxelValues copyOf(const VoxelValues& stored) {
  return std::visit(
      []<class T>(const std::vector<T>& values) -> VoxelValues {
        std::vector<T> copy = zeros<T>(values.size());
        parallelFor(std::int64_t(values.size()), 0, [&](std::int64_t begin, std::int64_t end) {
          std::copy(values.begin() + begin, values.begin() + end, copy.begin() + begin);
        });
        return copy;
      },
      stored);
}

VoxelValues maskedValues(const Volume& volume, const BitMask& kept) {
  VoxelValues copy = copyOf(volume.stored());
  std::visit(
      [&](auto& values) {
        const auto empty = storedNear(air, volume, values);
        const glm::ivec3 size = volume.size();
        parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
          for (std::int64_t row = begin; row < end; ++row) {
            const auto in = kept.row(int(row % size.y), int(row / size.y));
            const auto first = values.begin() + row * size.x;
            for (int i = 0; i < size.x; ++i) first[i] = bits::isSet(in, i) ? first[i] : empty;
          }
        });
      },
      copy);
  return copy;
}

Result<VolumePtr> volumeWith(const Volume& volume, VoxelValues values, const Cut& cut) {
  VolumeParts parts{volume.geometry(), std::move(values), volume.slope(), volume.intercept(),
                    volume.attributes()};
  parts.attributes.cut = cut;
  std::vector<std::string> warnings;  // unused: the values were checked when the volume was made
  return Volume::make(std::move(parts), warnings);
}

Error cancelled() { return {"Nothing was cut away: cancelled."}; }

Error noMemory() { return {"Nothing can be cut away: there is not enough memory for a second volume."}; }

}  // namespace

bool Mask::operator==(const Mask& other) const {
  return tableRemoved == other.tableRemoved &&
         std::equal(lassos.begin(), lassos.end(), other.lassos.begin(), other.lassos.end(),
                    [](const auto& a, const auto& b) { return a == b || *a == *b; });
}

BitMask keptVoxels(const Volume& volume, const Mask& mask, const CancelToken& cancel) {
  BitMask kept = beforeLassos(volume, mask, cancel);
  cutAll(kept, mask, cancel);
  return kept;
}

BitMask keptVoxelsInRange(const Volume& volume, ValueRange range, const Mask& mask,
                          const CancelToken& cancel) {
  BitMask found = voxelsInRange(volume, range);
  return mask.empty() ? found : intersected(std::move(found), keptVoxels(volume, mask, cancel));
}

BitMask leftBy(BitMask mask, const Lasso& lasso, double withinMm, const CancelToken& cancel) {
  const VoxelGeometry grid = mask.geometry();
  const glm::dvec3 forward = lasso.forward();
  const auto isWithin = [&](glm::dvec3 pVoxel) {
    const glm::dvec3 d = grid.patientFromVoxel(pVoxel) - lasso.origin;
    return std::abs(glm::dot(d, forward)) <= withinMm + depthRounding;
  };
  cutAway(
      grid, lasso,
      [&](int i, int j, int k) {
        return mask.at({i, j, k}) && isWithin({i, j, k});
      },
      [&](int i, int j, int k) {
        mask.set({i, j, k}, false);
      },
      cancel);
  return mask;
}

Result<VolumePtr> masked(const Volume& volume, const Mask& mask, const CancelToken& cancel) try {
  BitMask kept = beforeLassos(volume, mask, cancel);
  if (mask.tableRemoved && !cancel.cancelled() && kept.empty())
    return Error{"The table cannot be removed: nothing in this series is above -300 HU."};
  cutAll(kept, mask, cancel);
  if (cancel.cancelled()) return cancelled();
  return volumeWith(volume, maskedValues(volume, kept), {mask.tableRemoved, int(mask.lassos.size())});
} catch (const std::bad_alloc&) {
  return noMemory();
}

Result<VolumePtr> keptAlone(const Volume& volume, const BitMask& kept, const CancelToken& cancel,
                            bool tableRemoved) try {
  if (cancel.cancelled()) return cancelled();
  Cut cut = volume.attributes().cut;
  cut.table = cut.table || tableRemoved;
  return volumeWith(volume, maskedValues(volume, kept), cut);
} catch (const std::bad_alloc&) {
  return noMemory();
}

Result<VolumePtr> cutFurther(const Volume& volume, std::span<const std::shared_ptr<const Lasso>> lassos,
                             const CancelToken& cancel) try {
  VoxelValues copy = copyOf(volume.stored());
  std::visit(
      [&](auto& values) {
        cutAll(values, storedNear(air, volume, values), volume.geometry(), lassos, cancel);
      },
      copy);
  if (cancel.cancelled()) return cancelled();
  Cut all = volume.attributes().cut;
  all.outlines += int(lassos.size());
  return volumeWith(volume, std::move(copy), all);
} catch (const std::bad_alloc&) {
  return noMemory();
}

}  // namespace volumen
