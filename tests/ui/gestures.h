#pragma once

#include <QCoreApplication>
#include <QMouseEvent>
#include <QPointF>
#include <QTest>
#include <QWidget>

namespace volumen::tests {

/// Presses a button, moves in a few steps and releases: real mouse events. Positions in the widget's pixels.
inline void drag(QWidget* widget, QPointF from, QPointF to, Qt::MouseButton button = Qt::LeftButton,
                 Qt::KeyboardModifiers modifiers = {}) {
  constexpr int steps = 4;
  QTest::mousePress(widget, button, modifiers, from.toPoint());
  for (int n = 1; n <= steps; ++n)
    QTest::mouseEvent(QTest::MouseMove, widget, button, modifiers,
                      (from + (to - from) * (double(n) / steps)).toPoint());
  QTest::mouseRelease(widget, button, modifiers, to.toPoint());
}

/// The mouse passes over a widget, no button held.
inline void hover(QWidget* widget, QPointF at) {
  QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::NoButton, {});
  QCoreApplication::sendEvent(widget, &move);
}

}  // namespace volumen::tests
