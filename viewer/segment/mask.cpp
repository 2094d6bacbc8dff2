#include "viewer/segment/mask.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "viewer/segment/range.h"
#include "viewer/segment/table.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double air = -1000;

// A closed outline, its edges sorted into bands of y so that a point meets few of them.
class Outline {
 public:
  explicit Outline(const std::vector<glm::dvec2>& points) {
    if (points.empty()) return;
    low_ = high_ = points.front();
    for (const glm::dvec2 p : points) low_ = glm::min(low_, p), high_ = glm::max(high_, p);
    bands_.resize(std::clamp(points.size(), std::size_t(1), std::size_t(512)));
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Edge edge{points[n], points[(n + 1) % points.size()]};
      const std::size_t from = bandOf(edge.from.y), to = bandOf(edge.to.y);
      for (std::size_t band = std::min(from, to); band <= std::max(from, to); ++band)
        bands_[band].push_back(edge);
    }
  }

  bool holds(glm::dvec2 p) const {
    // Written so that what is no number lies outside.
    if (bands_.empty() || !(p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y)) return false;
    int winding = 0;
    for (const Edge& edge : bands_[bandOf(p.y)]) {
      const bool up = edge.from.y <= p.y;
      if (up == (edge.to.y <= p.y)) continue;
      const glm::dvec2 along = edge.to - edge.from, to = p - edge.from;
      const double side = along.x * to.y - along.y * to.x;
      if (up ? side > 0 : side < 0) winding += up ? 1 : -1;
    }
    return winding != 0;
  }

 private:
  struct Edge {
    glm::dvec2 from, to;
  };
  std::size_t bandOf(double y) const {
    const double height = high_.y - low_.y;
    const double part = height > 0 ? (y - low_.y) / height : 0;
    return std::min(std::size_t(part * double(bands_.size())), bands_.size() - 1);
  }

  glm::dvec2 low_{0}, high_{0};
  std::vector<std::vector<Edge>> bands_;
};

// Sets to `empty` what one lasso cuts; values that are so already are not looked at.
template <class T>
void cut(std::vector<T>& values, T empty, const VoxelGeometry& geometry, const Lasso& lasso,
         const CancelToken& cancel) {
  const Outline outline(lasso.points);
  const glm::dvec3 forward = lasso.forward();
  const auto cutsAway = [&](glm::dvec3 pPatient) {
    const glm::dvec3 d = pPatient - lasso.origin;
    glm::dvec2 p(glm::dot(d, lasso.right), glm::dot(d, lasso.down));
    const double depth = lasso.perspective ? glm::dot(d, forward) : 1;
    return (depth > 0 && outline.holds(p / depth)) == lasso.inside;
  };
  const int rowLength = geometry.size.x;
  parallelFor(geometry.voxelCount() / rowLength, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end && !cancel.cancelled(); ++row) {
      const glm::dvec3 first(0, double(row % geometry.size.y), double(row / geometry.size.y));
      T* const inRow = values.data() + row * rowLength;
      for (int i = 0; i < rowLength; ++i)
        if (inRow[i] != empty && cutsAway(geometry.patientFromVoxel({double(i), first.y, first.z})))
          inRow[i] = empty;
    }
  });
}

DenseLabels beforeLassos(const Volume& volume, const Mask& mask, const CancelToken& cancel) {
  if (mask.tableRemoved) return patientMask(volume, cancel);
  return {volume.geometry(), std::vector<std::uint8_t>(std::size_t(volume.geometry().voxelCount()), 1)};
}

void cutAll(DenseLabels& kept, const Mask& mask, const CancelToken& cancel) {
  for (const auto& lasso : mask.lassos)
    if (!cancel.cancelled()) cut(kept.labels, std::uint8_t(0), kept.geometry, *lasso, cancel);
}

// The stored value that means `value` best, within what its type and the volume hold.
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

VoxelValues maskedValues(const Volume& volume, const DenseLabels& kept) {
  VoxelValues copy = copyOf(volume.stored());
  std::visit(
      [&](auto& values) {
        const auto empty = storedNear(air, volume, values);
        parallelFor(std::int64_t(values.size()), 0, [&](std::int64_t begin, std::int64_t end) {
          for (std::int64_t n = begin; n < end; ++n)
            if (!kept.labels[std::size_t(n)]) values[std::size_t(n)] = empty;
        });
      },
      copy);
  return copy;
}

Error cancelled() { return {"Nothing was cut away: cancelled."}; }

Error noMemory() { return {"Nothing can be cut away: there is not enough memory for a second volume."}; }

}  // namespace

bool Mask::operator==(const Mask& other) const {
  return tableRemoved == other.tableRemoved &&
         std::equal(lassos.begin(), lassos.end(), other.lassos.begin(), other.lassos.end(),
                    [](const auto& a, const auto& b) { return a == b || *a == *b; });
}

DenseLabels keptVoxels(const Volume& volume, const Mask& mask, const CancelToken& cancel) {
  DenseLabels kept = beforeLassos(volume, mask, cancel);
  cutAll(kept, mask, cancel);
  return kept;
}

DenseLabels labelRange(const Volume& volume, ValueRange range, const Mask& mask, const CancelToken& cancel) {
  DenseLabels labels = labelRange(volume, range);
  if (mask.empty()) return labels;
  const DenseLabels kept = keptVoxels(volume, mask, cancel);
  for (std::size_t n = 0; n < labels.labels.size(); ++n) labels.labels[n] &= kept.labels[n];
  return labels;
}

Result<VolumePtr> masked(const Volume& volume, const Mask& mask, const CancelToken& cancel) try {
  DenseLabels kept = beforeLassos(volume, mask, cancel);
  if (mask.tableRemoved && !cancel.cancelled() && std::ranges::find(kept.labels, 1) == kept.labels.end())
    return Error{"The table cannot be removed: nothing in this series is above -300 HU."};
  cutAll(kept, mask, cancel);
  if (cancel.cancelled()) return cancelled();
  VolumeParts parts{volume.geometry(), maskedValues(volume, kept), volume.slope(), volume.intercept(),
                    volume.attributes()};
  parts.attributes.cut = {mask.tableRemoved, int(mask.lassos.size())};
  std::vector<std::string> warnings;  // its values were looked at when the volume was made
  return Volume::make(std::move(parts), warnings);
} catch (const std::bad_alloc&) {
  return noMemory();
}

Result<VolumePtr> cutFurther(const Volume& volume, std::span<const std::shared_ptr<const Lasso>> lassos,
                             const CancelToken& cancel) try {
  VoxelValues copy = copyOf(volume.stored());
  std::visit(
      [&](auto& values) {
        const auto empty = storedNear(air, volume, values);
        for (const auto& lasso : lassos)
          if (!cancel.cancelled()) cut(values, empty, volume.geometry(), *lasso, cancel);
      },
      copy);
  if (cancel.cancelled()) return cancelled();
  VolumeParts parts{volume.geometry(), std::move(copy), volume.slope(), volume.intercept(),
                    volume.attributes()};
  parts.attributes.cut.outlines += int(lassos.size());
  std::vector<std::string> warnings;
  return Volume::make(std::move(parts), warnings);
} catch (const std::bad_alloc&) {
  return noMemory();
}

}  // namespace volumen
