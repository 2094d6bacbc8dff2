#pragma once

#include <QCoreApplication>
#include <QDropEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QPointF>
#include <QTest>
#include <QWheelEvent>
#include <QWidget>

namespace volumen::tests {

/// Presses a button, moves in a few steps and releases, by real mouse events. Positions are in the widget's
/// pixels.
inline void drag(QWidget* widget, QPointF from, QPointF to, Qt::MouseButton button = Qt::LeftButton,
                 Qt::KeyboardModifiers modifiers = {}) {
  constexpr int steps = 4;
  QTest::mousePress(widget, button, modifiers, from.toPoint());
  for (int n = 1; n <= steps; ++n)
    QTest::mouseEvent(QTest::MouseMove, widget, button, modifiers,
                      (from + (to - from) * (double(n) / steps)).toPoint());
  QTest::mouseRelease(widget, button, modifiers, to.toPoint());
}

/// Moves the mouse over a widget with no button held.
inline void hover(QWidget* widget, QPointF at) {
  QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::NoButton, {});
  QCoreApplication::sendEvent(widget, &move);
}

/// Turns the wheel in the middle of a widget by `notches`; up is positive.
inline void wheel(QWidget* on, int notches, Qt::KeyboardModifiers keys = {}) {
  const QPointF middle(on->width() / 2.0, on->height() / 2.0);
  QWheelEvent event(middle, on->mapToGlobal(middle), {}, {0, 120 * notches}, Qt::NoButton, keys,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(on, &event);
}

/// Drops data on a widget if it accepts them. Returns whether it does.
inline bool drop(const QMimeData& what, QWidget* on) {
  constexpr QPoint at(20, 20);
  QDragEnterEvent enter(at, Qt::CopyAction, &what, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(on, &enter);
  if (!enter.isAccepted()) return false;
  QDropEvent drop(at, Qt::CopyAction, &what, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(on, &drop);
  return true;
}

}  // namespace volumen::tests
