#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/views/cross_lines.h"
#include "ui/views/flat_view.h"
#include "ui/views/latin_key.h"
#include "ui/views/time_bar.h"

namespace volumen {

const Tool* FlatView::toolFor(const QMouseEvent& event) const {
  switch (event.button()) {
    case Qt::LeftButton:
      if (event.modifiers() & Qt::ShiftModifier && !tool_->draws() && hasCursor())
        return &toolNamed("crosshair");
      // What has no place in the patient has no crosshair.
      return !hasCursor() && tool_ == &toolNamed("crosshair") ? nullptr : tool_;
    case Qt::MiddleButton:
      return &toolNamed("pan");
    case Qt::RightButton:
      return &toolNamed("zoom");
    default:
      return nullptr;
  }
}

void FlatView::mousePressEvent(QMouseEvent* event) {
  View::mousePressEvent(event);
  const Tool* tool = toolFor(*event);
  if (tool && tool->draws()) stop();
  const auto press = pressAt(event->position());
  if (drag_ && event->button() == Qt::LeftButton) drag_->press(event->position());
  if (!tool || !press || drag_) return;
  session_.endGesture();
  if (tool == tool_ && !tool->draws() && windowRect().contains(event->position())) return typeWindow();
  pressedAt_ = event->position();
  stepsAtPress_ = session_.undoStack().index();
  if (tool == tool_) drag_ = pressMeasurement(*press);
  if (!drag_ && tool == tool_ && !tool->draws()) drag_ = pressLine(*press);
  if (!drag_ && !hasWindow() && (tool == &toolNamed("window") || tool == &toolNamed("regionWindow"))) return;
  if (!drag_) drag_ = tool->inSlices(*press);
  if (drag_->drawing()) update();
}

void FlatView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) {
    drag_->moveTo(event->position(), event->modifiers());
    if (drag_->drawing()) update();
    return pointAt(event->position());
  }
  if (event->modifiers() & Qt::ShiftModifier && !tool_->draws() && hasCursor())
    if (const auto press = pressAt(event->position())) beginCrosshair(*press);
  showCursorAt(event->position());
  pointAt(event->position());
}

QString FlatView::textAt(QPointF position) const {
  const QString measured = measurementText(position);
  return measured.isEmpty() ? hoverText(position) : measured;
}

void FlatView::mouseReleaseEvent(QMouseEvent* event) {
  if (drag_ && drag_->drawing() &&
      (event->button() != Qt::LeftButton || !drag_->release(event->position(), event->modifiers())))
    return update();
  const bool isClick = (event->position() - pressedAt_).manhattanLength() < QApplication::startDragDistance();
  const bool wantsMenu = drag_ && event->button() == Qt::RightButton && isClick;
  endDrag(event->modifiers());
  if (wantsMenu) Q_EMIT menuRequested(event->globalPosition().toPoint());
}

void FlatView::wheelEvent(QWheelEvent* event) {
  pointAt(event->position());
  const auto press = pressAt(event->position());
  if (!press || drag_) return;
  // Alt makes a wheel horizontal on some systems.
  const double notches = (event->angleDelta().y() + event->angleDelta().x()) / 120.0;
  wheelEnd_.start();
  if (event->modifiers() & Qt::ControlModifier) {
    const double sign = session_.preferences().wheelInverted ? -1 : 1;
    return zoomFlat(session_, id(), flatLookOf(state()), press->plane, press->patientAt(press->at),
                    std::pow(0.85, -sign * notches));
  }
  wheelRest_ -= notches;
  const int steps = int(std::trunc(wheelRest_));
  wheelRest_ -= steps;
  if (event->modifiers() & Qt::AltModifier) return makeThicker(-steps);
  scroll(steps);
}

void FlatView::keyPressEvent(QKeyEvent* event) {
  if (pressMeasuringKey(*event)) return;
  switch (latinKey(*event)) {
    case Qt::Key_Up:
      return scroll(-1);
    case Qt::Key_Down:
      return scroll(1);
    case Qt::Key_PageUp:
      return scroll(-10);
    case Qt::Key_PageDown:
      return scroll(10);
    case Qt::Key_Home:
      return scroll(-place().count);
    case Qt::Key_End:
      return scroll(place().count);
    case Qt::Key_Left:
    case Qt::Key_Right:
      if (!time_->hasSteps()) break;
      return time_->step(event->key() == Qt::Key_Left ? -1 : 1);
    case Qt::Key_I:
      return invert();
    case Qt::Key_Escape:
      if (!drag_) break;
      drag_.reset();
      update();
      while (session_.undoStack().index() > stepsAtPress_) session_.undoStack().undo();
      tellPointed();
      return session_.endGesture();
    default:
      if (event->key() < Qt::Key_0 || event->key() > Qt::Key_9 || event->modifiers() != Qt::NoModifier) break;
      return chooseWindow(event->key() - Qt::Key_0);
  }
  View::keyPressEvent(event);
}

void FlatView::leaveEvent(QEvent* event) {
  update();
  View::leaveEvent(event);
}

}  // namespace volumen
