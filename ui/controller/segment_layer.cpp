#include "ui/controller/segment_layer.h"

#include <QRect>
#include <algorithm>
#include <glm/geometric.hpp>
#include <span>

#include "ui/controller/colour_mix.h"
#include "ui/controller/label_picture.h"
#include "viewer/volume/parallel.h"

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
    paintLabels(picture, plane, layer);
    return picture;
  }
  for (const SegmentLayer::Shown& shown : layer.shown) {
    const SegmentPlaces places(*layer.segmentation, shown.segment);
    paint(picture, labelledPixels(places, plane), std::span(&shown, 1), layer.opacity);
  }
  return picture;
}

}  // namespace volumen
