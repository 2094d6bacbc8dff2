#pragma once

#include "tests/ui/segment_window.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/brush.h"

namespace volumen::tests {

/// A window that shows hollowBalls() in planes and paints in them. The kernels compute the expected voxels.
struct PaintWindow : SegmentWindow {
  PaintWindow() { setBrush(false, 10); }

  void setBrush(bool ball, double mm) {
    session().prefer([&](Preferences& p) { p.brush = {ball, mm}; });
  }
  void take(const char* tool) { child<QAction>(tool)->trigger(); }
  const Tool& inHand() { return window.views()->tool(); }
  QString said() { return child<Banner>("banner")->sentence(); }
  QPoint pixelOf(glm::dvec3 p, ViewId id) {
    const glm::dvec2 pixel = view(id)->plane()->pixelFromPatient(p);
    return {int(pixel.x), int(pixel.y)};
  }
  std::vector<QPoint> pixelsOf(const std::vector<glm::dvec3>& way, ViewId id) {
    std::vector<QPoint> pixels;
    for (const glm::dvec3& p : way) pixels.push_back(pixelOf(p, id));
    return pixels;
  }
  void show(const Crosshair& crosshair) {
    session().change(QStringLiteral("test"), [&](Workspace& after) {
      after.crosshairs.editOrAdd(frameOfReference(*after.series.at(series()).series)) = crosshair;
    });
    session().endGesture();
  }
  void press(QPoint at, ViewId id = axialViewId, Qt::KeyboardModifiers keys = {}) {
    QTest::mousePress(view(id), Qt::LeftButton, keys, at);
  }
  void move(QPoint to, ViewId id = axialViewId, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseEvent(QTest::MouseMove, view(id), Qt::LeftButton, keys, to);
  }
  void release(QPoint at, ViewId id = axialViewId, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseRelease(view(id), Qt::LeftButton, keys, at);
  }
  void stroke(const std::vector<QPoint>& way, ViewId id = axialViewId, Qt::KeyboardModifiers keys = {}) {
    press(way.front(), id, keys);
    for (std::size_t n = 1; n < way.size(); ++n) move(way[n], id, keys);
    release(way.back(), id, keys);
  }
  const VoxelGeometry& grid() { return session().series()->volume->geometry(); }
  /// Returns the voxels that the brush covers along pixels of a view.
  BitMask covered(const std::vector<QPoint>& way, ViewId id = axialViewId) {
    BitMask mask(grid());
    const Brush brush = session().preferences().brush;
    for (std::size_t n = 0; n < way.size(); ++n) {
      const glm::dvec3 from = patient(way[n == 0 ? 0 : n - 1], id), to = patient(way[n], id);
      addSpans(mask, brush.ball
                         ? ballStroke(grid(), from, to, brush.diameterMm / 2)
                         : discStroke(grid(), from, to, view(id)->plane()->normal(), brush.diameterMm / 2));
    }
    return mask;
  }
  BitMask insideOf(const std::vector<QPoint>& corners, ViewId id = axialViewId) {
    std::vector<glm::dvec3> outline;
    for (const QPoint p : corners) outline.push_back(patient(p, id));
    BitMask mask(grid());
    addSpans(mask, insideOutline(grid(), outline, view(id)->plane()->normal()));
    return mask;
  }
  BitMask valuesFrom(double low, double high) {
    BitMask mask(grid());
    const Volume& volume = *session().series()->volume;
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          if (volume.value(i, j, k) >= low && volume.value(i, j, k) <= high) mask.set({i, j, k});
    return mask;
  }
};

/// A path through the hollow ball and its core.
inline const std::vector<glm::dvec3> throughBall{{-14, -5, -5}, {-8, -5, -5}, {-3, -5, -5}, {1, -5, -5}};
/// Returns planes through voxel centres near the centre of the ball.
inline Crosshair throughMiddle() {
  Crosshair crosshair;
  crosshair.at = glm::dvec3(-4.5);
  return crosshair;
}
inline Crosshair obliquely() {
  Crosshair crosshair = throughMiddle();
  crosshair.byHand = true;
  crosshair.axial = {glm::normalize(glm::dvec3(1, 0.4, 0.5)), {}};
  crosshair.axial.down = glm::normalize(glm::cross(glm::dvec3(-0.3, 0.2, 1), crosshair.axial.right));
  return crosshair;
}

}  // namespace volumen::tests
