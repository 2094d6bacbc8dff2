#pragma once

#include <QPolygonF>
#include <algorithm>
#include <limits>

#include "tests/ui/paint_window.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/segment_record.h"

namespace volumen::tests {

/// Corners about a pixel.
inline std::vector<QPoint> outlineAt(QPoint p, int size) {
  return {p + QPoint(-size, -size), p + QPoint(size, -size), p + QPoint(size / 2, 0), p + QPoint(size, size),
          p + QPoint(-size, size)};
}

/// How far a pixel is from an outline, whose last corner is joined to the first.
inline double fromOutline(const std::vector<QPoint>& corners, glm::dvec2 at) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const QPoint a = corners[n], b = corners[(n + 1) % corners.size()];
    const glm::dvec2 from(a.x(), a.y()), along = glm::dvec2(b.x(), b.y()) - from;
    const double part = std::clamp(glm::dot(at - from, along) / glm::dot(along, along), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(at, from + part * along));
  }
  return nearest;
}

/// What of a segment is seen in an outline; rounding may take what lies on the line to either side.
struct SeenPart {
  BitMask inside, onLine;
  bool leaves(const BitMask& left, const BitMask& expected) const {
    return subtracted(left, onLine) == subtracted(expected, onLine);
  }
};

/// Two segments, and the tool that cuts them in slices and in 3D.
struct CutWindow : PaintWindow {
  /// The segments 1 (hollow ball and small one) and 2 (core); 1 is current, the tool in hand.
  bool begin() {
    if (!makeBoth()) return false;
    take("segmentScissorsTool");
    return &inHand() == &toolNamed("segmentScissors");
  }
  VolumeView* scene() { return window.view(); }
  glm::dvec2 sceneSize() { return {double(scene()->width()), double(scene()->height())}; }
  QPoint scenePixel(glm::dvec3 p) {
    const glm::dvec2 at = seenAt(scene()->camera(), sceneSize(), p);
    return QPointF(at.x, at.y).toPoint();
  }
  /// By a drag that goes along the corners.
  void drawIn(QWidget* view, const std::vector<QPoint>& corners, Qt::KeyboardModifiers keys = {},
              bool isReleased = true) {
    QTest::mousePress(view, Qt::LeftButton, keys, corners.front());
    for (const QPoint p : corners) QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, keys, p);
    if (isReleased) QTest::mouseRelease(view, Qt::LeftButton, keys, corners.back());
  }
  /// The voxels of a segment of whose place in the patient this is so.
  template <class IsIn>
  BitMask partOf(int number, const IsIn& isIn) {
    BitMask part = mask(number);
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          if (part.at({i, j, k}) && !isIn(grid().patientFromVoxel({i, j, k}))) part.set({i, j, k}, false);
    return part;
  }
  /// Of the segment 1, by the pixels of a view.
  template <class PixelOf>
  SeenPart seenIn(const std::vector<QPoint>& corners, const PixelOf& pixel) {
    const QPolygonF outline(QList<QPointF>(corners.begin(), corners.end()));
    const auto isInside = [&](glm::dvec3 p) {
      const glm::dvec2 at = pixel(p);
      return outline.containsPoint({at.x, at.y}, Qt::WindingFill);
    };
    return {partOf(1, isInside),
            partOf(1, [&](glm::dvec3 p) { return fromOutline(corners, pixel(p)) < 1e-6; })};
  }
  SeenPart seenInScene(const std::vector<QPoint>& corners) {
    return seenIn(corners, [&](glm::dvec3 p) { return seenAt(scene()->camera(), sceneSize(), p); });
  }
  SeenPart seenInSlice(const std::vector<QPoint>& corners) {
    return seenIn(corners, [&](glm::dvec3 p) { return view()->plane()->pixelFromPatient(p); });
  }
  /// Whether the record makes the segments as they are.
  bool isRecorded() {
    const RecordedRecipe recorded = recordedRecipe(*map(), {});
    const auto made = follow(recorded.recipe, *session().series()->volume);
    if (!made || !recorded.missing.empty()) return false;
    return maskOf(made->labels, 1) == mask(1) && maskOf(made->labels, 2) == mask(2);
  }
};

}  // namespace volumen::tests
