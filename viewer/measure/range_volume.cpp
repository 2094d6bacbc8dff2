#include "viewer/measure/range_volume.h"

#include <algorithm>
#include <array>

#include "viewer/measure/cell_part.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

/// Largest error as a fraction of the volume: half of the 0.1 % that slices.md 4 allows.
constexpr double largestError = 5e-4;

// The values of slice k, clamped to the volume's slices, with a copy of each border voxel beside it.
class Slice {
 public:
  Slice(const Volume& volume, int k) : width_(std::size_t(volume.size().x) + 2) {
    const glm::ivec3 last = volume.size() - 1;
    values_.reserve(width_ * (std::size_t(last.y) + 3));
    for (int j = -1; j <= last.y + 1; ++j)
      for (int i = -1; i <= last.x + 1; ++i)
        values_.push_back(
            volume.value(std::clamp(i, 0, last.x), std::clamp(j, 0, last.y), std::clamp(k, 0, last.z)));
  }
  const float* row(int j) const { return values_.data() + std::size_t(j + 1) * width_ + 1; }

 private:
  std::size_t width_;
  std::vector<float> values_;
};

// The box ends half a voxel beyond the outermost centres, so the cells there are half as wide.
double width(int cell, int count) { return cell < 0 || cell == count - 1 ? 0.5 : 1; }

// Next to padding no interpolation is possible, so each corner stands for an eighth of the cell.
Part eighthsInRange(const std::array<float, 8>& corners, ValueRange range, ValueRange padding) {
  const auto counts = [&](float v) { return holds(range, double(v)) && !holds(padding, double(v)); };
  return {double(std::ranges::count_if(corners, counts)) / 8, 0};
}

Part cellPart(const std::array<float, 8>& corners, ValueRange range, const std::optional<ValueRange>& padding,
              double tolerance) {
  if (padding && std::ranges::any_of(corners, [&](float v) { return holds(*padding, double(v)); }))
    return eighthsInRange(corners, range, *padding);
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  if (double(*low) >= range.low && double(*high) <= range.high) return {1, 0};
  if (double(*high) < range.low || double(*low) > range.high) return {};
  std::array<double, 8> exact;
  std::copy(corners.begin(), corners.end(), exact.begin());
  return partInRange(exact, range, tolerance);
}

// Returns the part of the cells between slices k and k + 1, in voxels.
Part layerPart(const Volume& volume, int k, ValueRange range, double tolerance) {
  const glm::ivec3 size = volume.size();
  const Slice below(volume, k), above(volume, k + 1);
  Part layer;
  for (int j = -1; j < size.y; ++j) {
    const float *a = below.row(j), *b = below.row(j + 1), *c = above.row(j), *d = above.row(j + 1);
    Part row;
    for (int i = -1; i < size.x; ++i) {
      const Part cell = cellPart({a[i], a[i + 1], b[i], b[i + 1], c[i], c[i + 1], d[i], d[i + 1]}, range,
                                 volume.attributes().padding, tolerance);
      const double share = width(i, size.x);
      row += {cell.part * share, cell.error * share};
    }
    const double share = width(j, size.y) * width(k, size.z);
    layer += {row.part * share, row.error * share};
  }
  return layer;
}

// Adds layers in order, so that the digits do not depend on how they were shared among threads.
Part drawnPart(const Volume& volume, ValueRange range, double tolerance, const CancelToken& cancel) {
  std::vector<Part> layers(std::size_t(volume.size().z) + 1);
  parallelFor(std::int64_t(layers.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end && !cancel.cancelled(); ++n)
      layers[std::size_t(n)] = layerPart(volume, int(n) - 1, range, tolerance);
  });
  Part sum;
  for (Part layer : layers) sum += layer;
  return sum;
}

std::int64_t voxelsInRange(const Volume& volume, ValueRange range) {
  const std::optional<ValueRange>& padding = volume.attributes().padding;
  std::vector<std::int64_t> slices(std::size_t(volume.size().z));
  const std::size_t slice = std::size_t(volume.size().x) * std::size_t(volume.size().y);
  parallelFor(volume.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::size_t k = std::size_t(begin); k < std::size_t(end); ++k)
      for (std::size_t n = k * slice; n < (k + 1) * slice; ++n) {
        const double value = double(volume.valueAt(n));
        slices[k] += holds(range, value) && !isPadding(padding, value);
      }
  });
  std::int64_t voxels = 0;
  for (std::int64_t n : slices) voxels += n;
  return voxels;
}

}  // namespace

Result<RangeVolume> rangeVolume(const Volume& volume, ValueRange asked, const CancelToken& cancel) {
  const ValueRange range = inFloats(asked);
  RangeVolume result;
  result.voxels = voxelsInRange(volume, range);
  for (double tolerance = 0.02; tolerance > 1e-12; tolerance /= 8) {
    const Part drawn = drawnPart(volume, range, tolerance, cancel);
    if (cancel.cancelled()) return Error{"Interrupted."};
    result.drawnVoxels = drawn.part;
    if (drawn.error <= largestError * drawn.part) break;
  }
  return result;
}

}  // namespace volumen
