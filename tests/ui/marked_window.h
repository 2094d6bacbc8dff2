#pragma once

#include "tests/ui/segment_window.h"

namespace volumen::tests {

/// A window that shows a series in planes, with a length, a key image and a segment on it.
struct MarkedWindow : SegmentWindow {
  explicit MarkedWindow(const QString& path) : SegmentWindow(QStringList{path}) {}

  /// Makes these. Returns whether all are shown and measured.
  bool prepare() {
    if (!settle()) return false;
    child<QAction>("layoutPlanes")->trigger();
    session().setFocus(axialViewId);
    if (!QTest::qWaitFor([&] { return view() && !view()->picture().isNull(); }, longest)) return false;
    draw(ShapeKind::length, {{100, 100}, {160, 120}});
    session().select(0);
    view()->setFocus();
    QTest::keyClick(&window, Qt::Key_K);
    click("segmentFromCurve");
    return make(-100, 100) && QTest::qWaitFor([&] { return view()->isMeasured(); }, longest) &&
           QTest::qWaitFor([&] { return window.view()->hasItsPicture(); }, longest);
  }
};

}  // namespace volumen::tests
