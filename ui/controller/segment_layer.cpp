#include "ui/controller/segment_layer.h"

#include <QRect>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "ui/controller/colour_mix.h"
#include "viewer/volume/parallel.h"
#include "viewer/volume/voxel_box.h"

namespace volumen {

namespace {

// The pixels that a segment can hold; empty where the plane does not meet it.
QRect reachOf(const SegmentPlaces& places, const SlicePlane& plane) {
  const std::vector<glm::dvec3> corners = places.corners();
  if (corners.empty()) return {};
  glm::dvec2 low(1e9), high(-1e9);
  double before = 1e9, behind = -1e9;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec2 p = plane.pixelFromPatient(corner);
    low = glm::min(low, p), high = glm::max(high, p);
    const double away = glm::dot(corner - plane.centre, plane.normal());
    before = std::min(before, away), behind = std::max(behind, away);
  }
  constexpr double touching = 1e-3;  // mm
  if (before > touching || behind < -touching) return {};
  low = glm::clamp(glm::floor(low), glm::dvec2(0), glm::dvec2(plane.size));
  high = glm::clamp(glm::ceil(high), glm::dvec2(0), glm::dvec2(plane.size));
  return {QPoint(int(low.x), int(low.y)), QPoint(int(high.x) - 1, int(high.y) - 1)};
}

// Which of the shown segments each pixel of a part of the picture is in, from 1; 0: none.
struct LabelledPixels {
  QRect area;
  std::vector<std::uint8_t> labels;  // row by row

  explicit LabelledPixels(const QRect& part)
      : area(part), labels(std::size_t(part.width()) * std::size_t(part.height())) {}
  std::uint8_t& at(int x, int y) { return labels[place(x, y)]; }
  std::uint8_t at(int x, int y) const { return labels[place(x, y)]; }

 private:
  std::size_t place(int x, int y) const {
    return std::size_t(y - area.top()) * std::size_t(area.width()) + std::size_t(x - area.left());
  }
};

LabelledPixels labelledPixels(const SegmentPlaces& places, const SlicePlane& plane) {
  LabelledPixels pixels(reachOf(places, plane));
  for (int y = pixels.area.top(); y <= pixels.area.bottom(); ++y)
    for (int x = pixels.area.left(); x <= pixels.area.right(); ++x)
      pixels.at(x, y) = places.holds(plane.patientFromPixel({x + 0.5, y + 0.5}));
  return pixels;
}

// The voxels, whole bricks of them, in which a map has labels: from `low` on, before `high`.
VoxelBox labelledBox(const LabelMap& map) {
  VoxelBox box{map.geometry().size, glm::ivec3(0)};
  std::size_t n = 0;
  for (int k = 0; k < map.bricks().z; ++k)
    for (int j = 0; j < map.bricks().y; ++j)
      for (int i = 0; i < map.bricks().x; ++i) {
        const LabelMap::Brick& brick = map.brick(n++);
        if (!brick.voxels && brick.label == 0) continue;
        const glm::ivec3 first = glm::ivec3(i, j, k) * LabelMap::edge;
        box.low = glm::min(box.low, first);
        box.high = glm::max(box.high, glm::min(first + LabelMap::edge, map.geometry().size));
      }
  return box;
}

// Between which pixels of a row, the last one not among them, a box may be met: a little more than needed.
std::pair<int, int> pixelsWithin(const VoxelBox& box, glm::dvec3 first, glm::dvec3 step, int count) {
  double from = 0, to = count;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis] - first[axis], high = box.high[axis] - first[axis];
    if (std::abs(step[axis]) * count < 1e-6) {
      if (low > 1e-3 || high < -1e-3) return {0, 0};
      continue;
    }
    from = std::max(from, std::min(low / step[axis], high / step[axis]) - 1);
    to = std::min(to, std::max(low / step[axis], high / step[axis]) + 1);
  }
  return from < to ? std::pair(int(from), std::min(count, int(std::ceil(to)))) : std::pair(0, 0);
}

// From pixel to pixel the voxel goes on by the same step.
LabelledPixels labelledPixels(const LabelMap& map, const SlicePlane& plane, const SegmentLayer& layer) {
  std::array<std::uint8_t, 256> shownAs{};
  for (std::size_t n = 0; n < layer.shown.size(); ++n)
    shownAs[layer.shown[n].segment & 255] = std::uint8_t(n + 1);
  LabelledPixels pixels(QRect(0, 0, plane.size.x, plane.size.y));
  const auto voxelAt = [&](double x, double y) {
    const glm::dvec3 p = layer.fromPlane(plane.patientFromPixel({x, y}));
    return map.geometry().voxelFromPatient(p) + 0.5;  // of which the whole part is the nearest one
  };
  const glm::dvec3 first = voxelAt(0.5, 0.5), right = voxelAt(1.5, 0.5) - first,
                   down = voxelAt(0.5, 1.5) - first, size(map.geometry().size);
  const VoxelBox box = labelledBox(map);
  parallelFor(plane.size.y, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int y = int(begin); y < int(end); ++y) {
      const auto [from, to] = pixelsWithin(box, first + double(y) * down, right, plane.size.x);
      for (int x = from; x < to; ++x) {
        const glm::dvec3 v = first + double(x) * right + double(y) * down;
        const bool isInside =
            v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
        if (isInside) pixels.at(x, y) = shownAs[map.at(glm::ivec3(v))];
      }
    }
  });
  return pixels;
}

// Beyond the picture all goes on.
void paint(QImage& picture, const LabelledPixels& pixels, std::span<const SegmentLayer::Shown> shown,
           double opacity) {
  std::vector<ColourMix> insides, outlines;
  for (const SegmentLayer::Shown& segment : shown) {
    const double part = opacity * segment.opacity;
    insides.emplace_back(segment.colour, part);
    outlines.emplace_back(segment.colour, std::min(1.0, 2 * part));
  }
  const QRect area = pixels.area, whole = picture.rect();
  const auto differs = [&](int x, int y, std::uint8_t label) {
    if (x < 0 || y < 0 || x >= whole.width() || y >= whole.height()) return false;
    return !area.contains(x, y) || pixels.at(x, y) != label;
  };
  auto* const first = reinterpret_cast<QRgb*>(picture.bits());
  const auto width = std::size_t(picture.width());
  parallelFor(area.height(), 0, [&](std::int64_t begin, std::int64_t end) {
    for (int y = area.top() + int(begin); y < area.top() + int(end); ++y) {
      QRgb* line = first + std::size_t(y) * width;
      for (int x = area.left(); x <= area.right(); ++x) {
        const std::uint8_t label = pixels.at(x, y);
        if (label == 0) continue;
        const bool isOutline = differs(x - 1, y, label) || differs(x + 1, y, label) ||
                               differs(x, y - 1, label) || differs(x, y + 1, label);
        line[x] = (isOutline ? outlines : insides)[label - 1u](line[x]);
      }
    }
  });
}

}  // namespace

QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer) {
  if (picture.format() != QImage::Format_RGB32) picture = picture.convertToFormat(QImage::Format_RGB32);
  if (layer.labels) {
    if (!layer.shown.empty())
      paint(picture, labelledPixels(*layer.labels, plane, layer), layer.shown, layer.opacity);
    return picture;
  }
  for (const SegmentLayer::Shown& shown : layer.shown) {
    const SegmentPlaces places(*layer.segmentation, shown.segment);
    paint(picture, labelledPixels(places, plane), std::span(&shown, 1), layer.opacity);
  }
  return picture;
}

}  // namespace volumen
