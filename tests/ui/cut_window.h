#pragma once

#include <QPolygonF>
#include <algorithm>
#include <limits>

#include "results/segments/segment_record.h"
#include "tests/ui/paint_window.h"
#include "ui/workspace/camera_moves.h"

namespace volumen::tests {

/// Returns the corners of an outline around a pixel.
inline std::vector<QPoint> outlineAt(QPoint p, int size) {
  return {p + QPoint(-size, -size), p + QPoint(size, -size), p + QPoint(size / 2, 0), p + QPoint(size, size),
          p + QPoint(-size, size)};
}

/// Returns the distance of a pixel from a closed outline.
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

/// The part of a segment seen inside an outline. Rounding may put what lies on the line on either side.
struct SeenPart {
  BitMask inside, onLine;
  bool leaves(const BitMask& made, const BitMask& expected) const {
    return subtracted(made, onLine) == subtracted(expected, onLine);
  }
};

/// Two segments, and the scissors that cut them in slices and in 3D.
struct CutWindow : PaintWindow {
  /// Makes segment 1 (hollow ball and small ball, current) and segment 2 (core), and takes the scissors.
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
  /// Draws by a drag along the corners.
  void drawIn(QWidget* view, const std::vector<QPoint>& corners, Qt::KeyboardModifiers keys = {},
              bool isReleased = true) {
    QTest::mousePress(view, Qt::LeftButton, keys, corners.front());
    for (const QPoint p : corners) QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, keys, p);
    if (isReleased) QTest::mouseRelease(view, Qt::LeftButton, keys, corners.back());
  }
  /// Returns the voxels of a segment whose position in the patient fulfils `isIn`.
  template <class IsIn>
  BitMask partOf(int number, const IsIn& isIn) {
    BitMask part = mask(number);
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          if (part.at({i, j, k}) && !isIn(grid().patientFromVoxel({i, j, k}))) part.set({i, j, k}, false);
    return part;
  }
  /// Returns the part of segment 1 inside the outline, by the pixels of a view.
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
  /// Returns whether the recorded recipe reproduces the segments.
  bool isRecorded() {
    const RecordedRecipe recorded = recordedRecipe(*map(), {});
    const auto made = follow(recorded.recipe, *session().series()->volume);
    if (!made || !recorded.missing.empty()) return false;
    return maskOf(made->labels, 1) == mask(1) && maskOf(made->labels, 2) == mask(2);
  }
};

}  // namespace volumen::tests
