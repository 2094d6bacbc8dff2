#include "ui/controller/segment_layer.h"

#include <QRect>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

}  // namespace

QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer) {
  if (picture.format() != QImage::Format_RGB32) picture = picture.convertToFormat(QImage::Format_RGB32);
  for (const SegmentLayer::Shown& shown : layer.shown) {
    const SegmentPlaces places(*layer.segmentation, shown.segment);
    const QRect reach = reachOf(places, plane);
    for (int y = reach.top(); y <= reach.bottom(); ++y) {
      auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
      for (int x = reach.left(); x <= reach.right(); ++x)
        if (places.holds(plane.patientFromPixel({x + 0.5, y + 0.5})))
          line[x] = mixed(line[x], shown.colour, layer.opacity);
    }
  }
  return picture;
}

}  // namespace volumen
