#include "ui/controller/label_border.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

namespace volumen {

namespace {

constexpr double sameShare = 1e-6;  // more than rounding: planes halfway between slices are no noise

// The places, in voxels, where a map has labels, by whole bricks; its low end is above the high one where it
// has none.
std::pair<glm::dvec3, glm::dvec3> labelledBox(const LabelMap& map) {
  glm::ivec3 low = map.geometry().size, high(0);
  std::size_t n = 0;
  for (int k = 0; k < map.bricks().z; ++k)
    for (int j = 0; j < map.bricks().y; ++j)
      for (int i = 0; i < map.bricks().x; ++i) {
        const LabelMap::Brick& brick = map.brick(n++);
        if (!brick.voxels && brick.label == 0) continue;
        const glm::ivec3 first = glm::ivec3(i, j, k) * LabelMap::edge;
        low = glm::min(low, first);
        high = glm::max(high, glm::min(first + LabelMap::edge, map.geometry().size));
      }
  return {glm::dvec3(low) - 0.5, glm::dvec3(high) - 0.5};
}

}  // namespace

LabelBorder::LabelBorder(const SegmentLayer& layer, const SlicePlane& plane)
    : map_(layer.labels), nearest_(plane.interpolation == Interpolation::nearest), size_(plane.size) {
  for (std::size_t n = 0; n < layer.shown.size(); ++n)
    shownAs_[layer.shown[n].segment & 255] = std::uint8_t(n + 1);
  const auto voxelAt = [&](double x, double y) {
    return map_->geometry().voxelFromPatient(layer.fromPlane(plane.patientFromPixel({x, y})));
  };
  first_ = voxelAt(0, 0), right_ = voxelAt(1, 0) - first_, down_ = voxelAt(0, 1) - first_;
  std::tie(low_, high_) = labelledBox(*map_);
  const glm::dvec3 reach = 0.5 * (glm::abs(right_) + glm::abs(down_)) + (nearest_ ? 0.0 : 1.0);
  if (low_.x < high_.x) low_ -= reach, high_ += reach;
}

std::pair<int, int> LabelBorder::pixelsOfRow(int y) const {
  double from = 0, to = low_.x < high_.x ? size_.x : 0;
  const glm::dvec3 start = first_ + 0.5 * right_ + (y + 0.5) * down_;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = low_[axis] - start[axis], high = high_[axis] - start[axis], step = right_[axis];
    if (std::abs(step) * size_.x < 1e-6) {
      if (low > 1e-3 || high < -1e-3) return {0, 0};
      continue;
    }
    from = std::max(from, std::min(low / step, high / step) - 1);
    to = std::min(to, std::max(low / step, high / step) + 1);
  }
  return from < to ? std::pair(int(from), std::min(size_.x, int(std::ceil(to)))) : std::pair(0, 0);
}

// The border of a single voxel holds a disc of 0.41 voxels, of which a raster of 0.58 voxels misses none.
int LabelBorder::placesPerPixel() const {
  constexpr double raster = 0.58, most = 255;
  const double step = std::max(glm::length(right_), glm::length(down_));
  return int(std::clamp(std::ceil(step / raster - 1e-6), 1.0, most));
}

std::uint8_t LabelBorder::Reader::at(glm::dvec2 pPixel) {
  const glm::dvec3 v = of_.first_ + pPixel.x * of_.right_ + pPixel.y * of_.down_;
  const glm::dvec3 last = glm::dvec3(of_.map_->geometry().size) - 1.0;
  const bool isInside = v.x >= -0.5 && v.y >= -0.5 && v.z >= -0.5 && v.x < last.x + 0.5 &&
                        v.y < last.y + 0.5 && v.z < last.z + 0.5;
  if (!isInside) return 0;
  if (of_.nearest_) return of_.shownAs_[of_.map_->at(glm::ivec3(v + 0.5))];
  const glm::dvec3 held = glm::clamp(v, glm::dvec3(0), last);
  const glm::ivec3 cell(held);
  if (cell != cell_) read(cell);
  return kindCount_ == 1 ? kinds_[0].shown : largestShare(held - glm::dvec3(cell));
}

// The labels of a cell's eight voxels, i fastest; the last voxel of the grid stands for those beyond it.
void LabelBorder::Reader::read(glm::ivec3 cell) {
  constexpr int edge = LabelMap::edge;
  const LabelMap& map = *of_.map_;
  const glm::ivec3 brick = cell / edge, at = cell % edge;
  std::array<std::uint8_t, 8> labels;
  if (at.x < edge - 1 && at.y < edge - 1 && at.z < edge - 1) {
    const LabelMap::Brick& held =
        map.brick(std::size_t(brick.x + map.bricks().x * (brick.y + map.bricks().y * brick.z)));
    labels.fill(held.label);
    const std::size_t first = std::size_t(at.x + edge * (at.y + edge * at.z));
    for (std::size_t c = 0; held.voxels && c < 8; ++c)
      labels[c] = (*held.voxels)[first + (c & 1) + (c >> 1 & 1) * edge + (c >> 2) * edge * edge];
  } else {
    for (int c = 0; c < 8; ++c)
      labels[std::size_t(c)] =
          map.at(glm::min(cell + glm::ivec3(c & 1, c >> 1 & 1, c >> 2), map.geometry().size - 1));
  }
  setKinds(labels);
  cell_ = cell;
}

void LabelBorder::Reader::setKinds(const std::array<std::uint8_t, 8>& labels) {
  kindCount_ = 1;
  kinds_[0].shown = of_.shownAs_[labels[0]];
  if (std::ranges::all_of(labels, [&](std::uint8_t label) { return label == labels[0]; })) return;
  std::array<std::uint8_t, 8> shown, kinds;
  std::ranges::transform(labels, shown.begin(), [&](std::uint8_t label) { return of_.shownAs_[label]; });
  kinds = shown;
  std::ranges::sort(kinds, {}, [](std::uint8_t kind) { return std::uint8_t(kind - 1); });
  kindCount_ = int(std::ranges::unique(kinds).begin() - kinds.begin());
  for (std::size_t n = 0; n < std::size_t(kindCount_); ++n) {
    kinds_[n].shown = kinds[n];
    for (std::size_t c = 0; c < 8; ++c) kinds_[n].corners[c] = shown[c] == kinds[n] ? 1 : 0;
  }
}

std::uint8_t LabelBorder::Reader::largestShare(glm::dvec3 within) const {
  std::uint8_t largest = 0;
  double most = -1, left = 1;  // what is left of 1
  for (std::size_t n = 0; n < std::size_t(kindCount_) && most < left + sameShare; ++n) {
    const std::array<double, 8>& c = kinds_[n].corners;
    const auto alongI = [&](std::size_t k) { return c[k] + within.x * (c[k + 1] - c[k]); };
    const double near = alongI(0) + within.y * (alongI(2) - alongI(0));
    const double far = alongI(4) + within.y * (alongI(6) - alongI(4));
    const double share = near + within.z * (far - near);
    if (share > most + sameShare) most = share, largest = kinds_[n].shown;
    left -= share;
  }
  return largest;
}

}  // namespace volumen
