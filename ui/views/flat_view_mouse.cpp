#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <string>

#include "ui/tools/mouse_bindings.h"
#include "ui/views/cine_bar.h"
#include "ui/views/flat_view.h"
#include "ui/views/latin_key.h"

namespace volumen {

namespace {
constexpr double fastScroll = 10;  // factor of "fast"
}

const Tool* FlatView::toolFor(const QMouseEvent& event) const {
  const bool isLeft = event.button() == Qt::LeftButton;
  if (!isLeft && event.button() != Qt::MiddleButton && event.button() != Qt::RightButton) return nullptr;
  if (isLeft && tool_->draws()) return tool_;
  std::string bound =
      boundTo(session_.preferences(), slotOf(MousePlace::flat, event.button(), event.modifiers()));
  // Series without a position in the patient have no crosshair.
  if (bound == "crosshair" && !hasCursor()) bound = isLeft ? "chosen" : "none";
  if (bound == "none") return nullptr;
  if (bound != "chosen") return &toolNamed(bound);
  return !hasCursor() && hasCrosshairTool() ? nullptr : tool_;
}

void FlatView::mousePressEvent(QMouseEvent* event) {
  View::mousePressEvent(event);
  const Tool* tool = toolFor(*event);
  const bool isChosen = tool == tool_ && event->button() == Qt::LeftButton;
  if (tool && tool->draws()) stop();
  if (!drag_) pressedAt_ = event->position();
  auto press = pressAt(event->position());
  seeDrag();
  if (drag_ && event->button() == dragButton_) drag_->press(event->position());
  if (!press || drag_) return;
  press->keys = event->modifiers();
  press->segments = segments_;
  dragButton_ = event->button();
  session_.endGesture();
  stepsAtPress_ = session_.undoStack().index();
  if (event->button() == Qt::LeftButton) drag_ = pressStackBar(event->position());
  if (drag_ || !tool || (isChosen && pressCorner(event->position()))) return;
  const bool isHand = isChosen && !tool->looking;
  if (isHand) drag_ = pressMeasurement(*press);
  if (!drag_ && isHand && !tool->draws()) drag_ = pressLine(*press);
  if (!drag_ && !windowShown() && (tool == &toolNamed("window") || tool == &toolNamed("regionWindow")))
    return;
  if (!drag_) drag_ = tool->inSlices(*press);
  showDrawing();
  askForLens();
}

void FlatView::mouseMoveEvent(QMouseEvent* event) {
  if (tool_->paintAt) update();
  if (drag_) {
    seeDrag();
    drag_->moveTo(event->position(), event->modifiers());
    showDrawing();
    askForLens();
    return pointAt(event->position());
  }
  if (takesCrosshair(*event))
    if (const auto press = pressAt(event->position())) beginCrosshair(*press);
  tellEdges(event->position());
  showCursorAt(event->position());
  pointAt(event->position());
}

// Tells drags across slices which slice is shown.
void FlatView::seeDrag() {
  if (const auto now = drag_ && drag_->scrolls() ? plane() : std::nullopt) drag_->planeChanged(*now);
}

bool FlatView::movesCrosshair(Qt::KeyboardModifiers keys) const {
  const MouseSlot slot{MousePlace::flat, MouseInput::move, heldOf(keys)};
  return slot.held && !tool_->draws() && hasCursor() && boundTo(session_.preferences(), slot) == "crosshair";
}

// Returns whether the pointer moves the crosshair. A hand that holds the key for the wheel is not quite
// still.
bool FlatView::takesCrosshair(const QMouseEvent& event) {
  if (!movesCrosshair(event.modifiers())) {
    heldAt_ = event.position();
    return false;
  }
  if (heldAt_ && (event.position() - *heldAt_).manhattanLength() < QApplication::startDragDistance())
    return false;
  heldAt_.reset();
  return true;
}

QString FlatView::textAt(QPointF position) const {
  if (isOnStackBar(position)) return tr("Drag to go through the stack (G: by its number)");
  const QString measured = measurementText(position);
  return measured.isEmpty() ? hoverText(position) : measured;
}

void FlatView::mouseReleaseEvent(QMouseEvent* event) {
  if (drag_ && event->button() != dragButton_) return;
  seeDrag();
  if (isDrawing() && !drag_->release(event->position(), event->modifiers())) return update();
  const bool isClick = (event->position() - pressedAt_).manhattanLength() < QApplication::startDragDistance();
  const bool wantsMenu =
      event->button() == Qt::RightButton && isClick && (drag_ || (shown() && !toolFor(*event)));
  endDrag(event->modifiers());
  if (wantsMenu) Q_EMIT menuRequested(event->globalPosition().toPoint());
}

void FlatView::wheelEvent(QWheelEvent* event) {
  pointAt(event->position());
  heldAt_ = event->position();
  const auto press = pressAt(event->position());
  // Alt and Shift make a wheel horizontal on some systems.
  const double notches = (event->angleDelta().y() + event->angleDelta().x()) / 120.0;
  if (drag_ && drag_->wheel(notches)) return askForLens();
  if (!press || (drag_ && !drag_->scrolls())) return;
  const MouseSlot slot{MousePlace::flat, MouseInput::wheel, heldOf(event->modifiers())};
  const std::string bound = boundTo(session_.preferences(), slot);
  wheelEnd_.start();
  if (bound == "none") return;
  if (bound == "zoom") return zoomBy(*press, std::pow(0.85, -wheelSign() * notches));
  // A wheel reports no pixels to pan by.
  if (bound == "pan" && !event->pixelDelta().isNull()) {
    beginSlicePan(*press)->moveTo(press->at + event->pixelDelta(), {});
    return;
  }
  wheelRest_ -= bound == "fast" ? fastScroll * notches : notches;
  const int steps = int(std::trunc(wheelRest_));
  wheelRest_ -= steps;
  if (bound == "slab") return makeThicker(-steps);
  scroll(steps);
  if (!drag_) return;
  seeDrag();
  drag_->moveTo(event->position(), event->modifiers());
  showDrawing();
}

double FlatView::wheelSign() const { return session_.preferences().wheelInverted ? -1 : 1; }

void FlatView::zoomBy(const SlicePress& press, double factor) {
  zoomFlat(session_, id(), flatLookOf(state()), press.plane, press.patientAt(press.at), factor);
}

// Two fingers moving apart zoom in about the point between them.
bool FlatView::pinch(const QNativeGestureEvent& event) {
  const auto press = pressAt(event.position());
  if (event.gestureType() != Qt::ZoomNativeGesture || !press || drag_) return false;
  zoomBy(*press, std::clamp(1 + event.value(), 0.1, 10.0));
  wheelEnd_.start();
  return true;
}

// Handles the keys of the selected tool and of the current drag.
bool FlatView::pressToolKey(const QKeyEvent& event) {
  const int key = latinKey(event);
  const bool isTaken = (tool_->takesKey && tool_->takesKey(session_, key)) || (drag_ && drag_->takesKey(key));
  if (isTaken) update();
  return isTaken;
}

// Digits select windows; with Ctrl they select windows of the file.
bool FlatView::pressWindowKey(const QKeyEvent& event) {
  const int digit = event.key() - Qt::Key_0;
  const bool isCtrl = event.modifiers() == Qt::ControlModifier;
  if (digit < 0 || digit > 9 || (!isCtrl && event.modifiers() != Qt::NoModifier)) return false;
  const std::vector<WindowChoice> all = windows();
  const auto chosen = std::ranges::find_if(all, [&](const WindowChoice& choice) {
    return (isCtrl ? choice.key.withCtrl : choice.key.alone) == digit;
  });
  if (chosen != all.end()) chooseWindow(int(chosen - all.begin()));
  return true;
}

void FlatView::keyPressEvent(QKeyEvent* event) {
  if (pressToolKey(*event) || pressMeasuringKey(*event)) return;
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
      return scroll(-stack().place.count);
    case Qt::Key_End:
      return scroll(stack().place.count);
    case Qt::Key_Left:
    case Qt::Key_Right:
      if (!cine_->stepTime(event->key() == Qt::Key_Left ? -1 : 1)) break;
      return;
    case Qt::Key_Plus:
    case Qt::Key_Minus:
      if (!cine_->stepRate(event->key() == Qt::Key_Minus ? -1 : 1)) break;
      return;
    case Qt::Key_I:
      return invert();
    case Qt::Key_Escape:
      if (!drag_) break;
      giveUpDrag();
      askForLens();
      update();
      while (session_.undoStack().index() > stepsAtPress_) session_.undoStack().undo();
      tellPointed();
      return session_.endGesture();
    default:
      if (!pressWindowKey(*event)) break;
      return;
  }
  View::keyPressEvent(event);
}

void FlatView::hideEvent(QHideEvent* event) {
  stop();
  closeFields();
  // A view that is not seen holds no volumes.
  asked_.reset();
  drawn_.reset();
  View::hideEvent(event);
}

void FlatView::leaveEvent(QEvent* event) {
  heldAt_.reset();
  tellEdges({-1, -1});
  update();
  View::leaveEvent(event);
}

}  // namespace volumen
