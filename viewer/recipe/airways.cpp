#include "viewer/recipe/airways.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "viewer/segment/numbers.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/range.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

constexpr double airHu = -800, leastMm2 = 60, mostMm2 = 700, longMm = 30, mostAspect = 2;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The slices of a volume across an axis, each a grid of its own.
class Slices {
 public:
  Slices(const VoxelGeometry& grid, int axis) : grid_(grid), axis_(axis) {
    grid_.size[axis] = 1;
    const glm::dmat3& step = grid.patientFromVoxelStep;
    pixelMm2_ = glm::length(glm::cross(step[(axis + 1) % 3], step[(axis + 2) % 3]));
  }

  BitMask slice(const BitMask& mask, int at) const {
    BitMask slice(grid_);
    for (int k = 0; k < grid_.size.z; ++k)
      for (int j = 0; j < grid_.size.y; ++j)
        for (int i = 0; i < grid_.size.x; ++i)
          if (mask.at(inVolume({i, j, k}, at))) slice.set({i, j, k});
    return slice;
  }

  glm::ivec3 inVolume(glm::ivec3 voxel, int at) const {
    voxel[axis_] = at;
    return voxel;
  }

  double areaMm2(std::int64_t voxels) const { return double(voxels) * pixelMm2_; }

  /// Returns the centroid in mm; empty if the slice is.
  std::optional<glm::dvec3> middle(const BitMask& slice) const {
    const std::vector<glm::ivec3> voxels = voxelsOf(slice);
    if (voxels.empty()) return {};
    glm::dvec3 sum(0);
    for (const glm::ivec3& v : voxels) sum += glm::dvec3(v);
    return grid_.patientFromVoxel(sum / double(voxels.size()));
  }

  /// Returns whether the aspect ratio of its box is at most mostAspect.
  bool isRound(const BitMask& region) const {
    glm::ivec3 low(std::numeric_limits<int>::max()), high(-1);
    for (const glm::ivec3& v : voxelsOf(region)) low = glm::min(low, v), high = glm::max(high, v);
    const glm::dvec3 mm = glm::dvec3(high - low + 1) * grid_.spacing();
    const double a = mm[(axis_ + 1) % 3], b = mm[(axis_ + 2) % 3];
    return std::max(a, b) <= mostAspect * std::min(a, b);
  }

  /// Returns the regions of a slice that could be the trachea.
  std::vector<BitMask> regions(const BitMask& air) const {
    std::vector<BitMask> found;
    const Parts parts(air, Neighbours::faces);
    std::vector<bool> chosen(parts.count());
    for (std::size_t n = 0; n < parts.count(); ++n) {
      if (const double area = areaMm2(parts.size(n)); area < leastMm2 || area > mostMm2) continue;
      chosen.assign(parts.count(), false);
      chosen[n] = true;
      if (BitMask region = parts.mask(chosen); isRound(region)) found.push_back(std::move(region));
    }
    return found;
  }

 private:
  VoxelGeometry grid_;
  int axis_;
  double pixelMm2_ = 0;
};

class TracheaSearch {
 public:
  TracheaSearch(const BitMask& air, const BitMask& body)
      : air_(air), body_(body), axis_(axisAlongPatient(air.geometry())), slices_(air.geometry(), axis_) {
    const glm::dmat3& step = air.geometry().patientFromVoxelStep;
    count_ = air.size()[axis_];
    isUpwards_ = step[axis_].z > 0;
    longSlices_ = std::max(2, int(std::ceil(longMm / air.geometry().spacing()[axis_])));
  }

  std::optional<BitMask> run(const CancelToken& cancel) const {
    for (int n = 0; n + longSlices_ <= count_ && !cancel.cancelled(); ++n)
      if (const auto region = best(n)) return inVolume(*region, n);
    return {};
  }

 private:
  // Returns the index of the n-th slice from above.
  int indexOf(int n) const { return isUpwards_ ? count_ - 1 - n : n; }
  BitMask air(int n) const { return slices_.slice(air_, indexOf(n)); }

  bool goesOn(BitMask region, int n) const {
    for (int next = n + 1; next < n + longSlices_; ++next) {
      std::optional<BitMask> below;
      for (BitMask& other : slices_.regions(air(next)))
        if (!intersected(region, other).empty()) below = std::move(other);
      if (!below) return false;
      region = std::move(*below);
    }
    return true;
  }

  std::optional<BitMask> best(int n) const {
    const auto middle = slices_.middle(slices_.slice(body_, indexOf(n)));
    if (!middle) return {};
    std::optional<BitMask> nearest;
    double distance = infinity;
    for (BitMask& region : slices_.regions(air(n)))
      if (const double mm = glm::distance(*slices_.middle(region), *middle);
          mm < distance && goesOn(region, n))
        distance = mm, nearest = std::move(region);
    return nearest;
  }

  BitMask inVolume(const BitMask& region, int n) const {
    BitMask mask(air_.geometry());
    for (const glm::ivec3& v : voxelsOf(region)) mask.set(slices_.inVolume(v, indexOf(n)));
    return mask;
  }

  const BitMask &air_, &body_;
  int axis_;
  Slices slices_;
  int count_ = 0, longSlices_ = 0;
  bool isUpwards_ = false;
};

}  // namespace

Result<BitMask> tracheaOf(const Volume& volume, const BitMask& body, const CancelToken& cancel) {
  if (!volume.geometry().calibrated) return Error{"the series has no millimetres"};
  const BitMask air = intersected(voxelsInRange(volume, {-infinity, airHu}), body);
  const auto found = TracheaSearch(air, body).run(cancel);
  if (!found) return Error{"no trachea was found: no round region of air that goes on for 3 cm"};
  return *found;
}

Result<BitMask> airTreeOf(const Volume& volume, const std::vector<glm::ivec3>& seeds, AirTreeLimits limits,
                          const CancelToken& cancel) {
  if (seeds.empty()) return Error{"it has nothing to start from"};
  const auto upTo = [&](double most) {
    return connected(voxelsInRange(volume, {-infinity, most}), seeds, Neighbours::faces, cancel);
  };
  const double mlOfVoxel = volume.geometry().voxelVolume() / 1000;
  const auto fits = [&](const BitMask& tree) { return double(tree.count()) * mlOfVoxel <= limits.mostMl; };
  double low = infinity;
  for (const glm::ivec3& seed : seeds) low = std::min(low, double(volume.value(seed.x, seed.y, seed.z)));
  low = std::floor(std::min(low, limits.most)), limits.most = std::max(low, limits.most);
  BitMask tree = upTo(limits.most);
  if (fits(tree)) return tree;
  double high = std::ceil(limits.most);  // whole, so that the midpoint differs from it
  std::optional<BitMask> largest;
  while (high - low > 1 && !cancel.cancelled()) {
    const double middle = std::floor((low + high) / 2);
    if (tree = upTo(middle); fits(tree) && !tree.empty())
      low = middle, largest = std::move(tree);
    else if (tree.empty())
      low = middle;
    else
      high = middle;
  }
  if (!largest) return Error{"it is larger than the most ml at every value"};
  return *largest;
}

}  // namespace volumen
