#pragma once

#include <QScrollArea>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/ui/final_picture.h"
#include "tests/ui/segment_window.h"

namespace volumen::tests {

/// A small screen with studies in their hanging. The Segments panel is in front and most space is beside the
/// panels.
struct LooksWindow : SegmentWindow {
  FinalPicture rest{window};  ///< of the 3D view

  explicit LooksWindow(const QStringList& paths) : SegmentWindow(paths) { window.resize(1366, 768); }

  /// Returns true once all views have their picture.
  bool open() {
    return QTest::qWaitFor([this] { return session().series() && areDrawn(); }, longest) && idle();
  }
  bool areDrawn() {
    return std::ranges::all_of(viewsOnScreen(workspace()), [this](ViewId id) {
      const View* view = window.views()->viewOf(id);
      if (const auto* flat = qobject_cast<const FlatView*>(view)) return !flat->picture().isNull();
      const auto* scene = qobject_cast<const VolumeView*>(view);
      return scene && !scene->picture().isNull();
    });
  }
  void begin() {
    child<QDockWidget>("transferDock")->raise();
    child<QDockWidget>("segmentDock")->raise();
    window.resizeDocks({child<QDockWidget>("transferDock"), child<QDockWidget>("segmentDock")}, {130, 530},
                       Qt::Vertical);
    QCoreApplication::processEvents();
  }
  void shot(const char* name) {
    QCoreApplication::processEvents();  // lays out texts
    Journey::shot(name);
  }
  void take(const char* tool) { child<QAction>(tool)->trigger(); }
  VolumeView* scene() { return window.view(); }
  /// Returns true once the 3D view shows the picture at rest of its present scene.
  bool isAtRest() {
    return idle() && QTest::qWaitFor([this] { return rest.isThere(); }, longest);
  }
  void press(QWidget* on, QPoint at, Qt::KeyboardModifiers keys = {}) {
    QTest::mousePress(on, Qt::LeftButton, keys, at);
  }
  void move(QWidget* on, QPoint to, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseEvent(QTest::MouseMove, on, Qt::LeftButton, keys, to);
  }
  void release(QWidget* on, QPoint at, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseRelease(on, Qt::LeftButton, keys, at);
  }
  /// Presses at the first position and moves along the others.
  void go(QWidget* on, const std::vector<QPoint>& way, Qt::KeyboardModifiers keys = {}) {
    press(on, way.front(), keys);
    for (const QPoint p : way) move(on, p, keys);
  }
  void stroke(const std::vector<QPoint>& way) {
    go(view(), way);
    release(view(), way.back());
  }
  /// Returns the logical pixels of `mm` in a flat view.
  int pixels(double mm, ViewId id = axialViewId) {
    const FlatView* on = view(id);
    return int(mm / on->plane()->mmPerPixel / on->devicePixelRatioF());
  }
  /// Shows the slice through a position and returns the corners of a circle of `mm` around it.
  std::vector<QPoint> roundAt(glm::dvec3 p, double mm, ViewId id = axialViewId) {
    const QPoint at = showPlace(p, id);
    std::vector<QPoint> corners;
    for (int n = 0; n < 24; ++n) {
      const double turn = n * 2 * std::numbers::pi / 24;
      corners.push_back(at + (pixels(mm, id) * QPointF(std::cos(turn), 0.8 * std::sin(turn))).toPoint());
    }
    return corners;
  }
  /// Waits until more than `pixels` pixels of a view's picture, without overlays, are tinted.
  bool isTinted(int pixels) {
    return QTest::qWaitFor([&] { return coloured() > pixels; }, longest);
  }
  QImage seen(QWidget* on) { return on->grab().toImage(); }
  /// Returns the number of pixels that differ.
  static int unlike(const QImage& a, const QImage& b) {
    int count = 0;
    for (int y = 0; y < std::min(a.height(), b.height()); ++y)
      for (int x = 0; x < std::min(a.width(), b.width()); ++x) count += a.pixel(x, y) != b.pixel(x, y);
    return count;
  }
  /// Shows the page of a button, and scrolls its lowest widget into sight if possible.
  void showPage(const char* name, const char* lowest) {
    click(name);
    QCoreApplication::processEvents();
    auto* below = child<QWidget>(lowest);
    for (QWidget* over = below->parentWidget(); over; over = over->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(over)) area->ensureWidgetVisible(below);
    QCoreApplication::processEvents();
  }
};

}  // namespace volumen::tests
