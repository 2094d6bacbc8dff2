#include "ui/controller/segment_layer.h"

#include <QRect>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

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

QRgb mixed(QRgb under, QRgb over, double part) {
  const auto channel = [&](int a, int b) { return int(std::lround((1 - part) * a + part * b)); };
  return qRgb(channel(qRed(under), qRed(over)), channel(qGreen(under), qGreen(over)),
              channel(qBlue(under), qBlue(over)));
}

// Which of the shown segments each pixel of a part of the picture is in, from 1; 0: none.
struct LabelledPixels {
  QRect area;
  std::vector<std::uint8_t> labels;  // row by row

  explicit LabelledPixels(const QRect& part)
      : area(part), labels(std::size_t(part.width()) * std::size_t(part.height())) {}
  std::uint8_t& at(int x, int y) {
    return labels[std::size_t(y - area.top()) * std::size_t(area.width()) + std::size_t(x - area.left())];
  }
};

LabelledPixels labelledPixels(const SegmentPlaces& places, const SlicePlane& plane) {
  LabelledPixels pixels(reachOf(places, plane));
  for (int y = pixels.area.top(); y <= pixels.area.bottom(); ++y)
    for (int x = pixels.area.left(); x <= pixels.area.right(); ++x)
      pixels.at(x, y) = places.holds(plane.patientFromPixel({x + 0.5, y + 0.5}));
  return pixels;
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
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      const glm::dvec3 v = first + double(x) * right + double(y) * down;
      const bool isInside = v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
      if (isInside) pixels.at(x, y) = shownAs[map.at(glm::ivec3(v))];
    }
  return pixels;
}

// Beyond the picture all goes on.
void paint(QImage& picture, LabelledPixels pixels, std::span<const SegmentLayer::Shown> shown,
           double opacity) {
  const QRect area = pixels.area;
  const auto differs = [&](int x, int y, std::uint8_t label) {
    if (!picture.rect().contains(x, y)) return false;
    return !area.contains(x, y) || pixels.at(x, y) != label;
  };
  for (int y = area.top(); y <= area.bottom(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = area.left(); x <= area.right(); ++x) {
      const std::uint8_t label = pixels.at(x, y);
      if (label == 0) continue;
      const SegmentLayer::Shown& segment = shown[label - 1u];
      const bool isOutline = differs(x - 1, y, label) || differs(x + 1, y, label) ||
                             differs(x, y - 1, label) || differs(x, y + 1, label);
      const double part = opacity * segment.opacity;
      line[x] = mixed(line[x], segment.colour, isOutline ? std::min(1.0, 2 * part) : part);
    }
  }
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
