#include <QKeyEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "results/text/text.h"
#include "ui/tools/mouse_bindings.h"
#include "ui/tools/tool.h"
#include "ui/views/cine_bar.h"
#include "ui/views/volume_view.h"

namespace volumen {

namespace {
glm::dvec2 toVec(QPointF p) { return {p.x(), p.y()}; }
}  // namespace

const Tool* VolumeView::toolFor(const QMouseEvent& event) const {
  const bool isLeft = event.button() == Qt::LeftButton;
  if (!isLeft && event.button() != Qt::MiddleButton && event.button() != Qt::RightButton) return nullptr;
  if (isLeft && drawing_) return drawing_;
  // In projections Shift makes window drags fine.
  if (isLeft && tool_ == &toolNamed("curve") && scene().mode != Mode::composite) return tool_;
  const std::string bound =
      boundTo(session_.preferences(), slotOf(MousePlace::scene, event.button(), event.modifiers()));
  return bound == "chosen" ? tool_ : bound == "none" ? nullptr : &toolNamed(bound);
}

ScenePress VolumeView::pressAt(QPointF position, Qt::KeyboardModifiers keys) {
  const std::optional<Pick> hit = pickAt(position);
  ScenePress press{session_,
                   id(),
                   series(),
                   scene(),
                   position,
                   size(),
                   keys,
                   hit ? hit->pPatient : std::nullopt,
                   [this](const QString& text, const Camera& camera) { editCamera(text, camera); },
                   [this](const Lasso& lasso) { Q_EMIT lassoDrawn(state().series, lasso); },
                   [this](QPointF p) -> std::optional<SurfacePoint> {
                     const std::optional<Pick> at = pickAt(p);
                     if (!at || !at->pPatient || !at->softMm) return {};
                     return SurfacePoint{*at->pPatient, *at->softMm};
                   },
                   [this](QPointF p) { tellMissed(p); },
                   segments_};
  press.scene.camera = camera();
  return press;
}

void VolumeView::mousePressEvent(QMouseEvent* event) {
  isChosenByPress_ = session_.workspace().focus != id();
  beforePick_.reset();
  View::mousePressEvent(event);
  if (!series() || drag_) return;
  if (shape_ && event->button() == Qt::LeftButton) {
    shape_->press(event->position());
    shapePressed_ = true;
    return redraw();
  }
  // The camera stays while a point of the shape is dragged.
  if (shape_ && (event->buttons() & Qt::LeftButton)) return;
  pressedAt_ = event->position();
  pressedShape_ = pressedFree_ = false;
  const Tool* tool = toolFor(*event);
  if (!tool) return;
  dragButton_ = event->button();
  if (tool->draws()) cine_->stop();
  session_.endGesture();
  stepsAtPress_ = session_.undoStack().index();
  const ScenePress press = pressAt(event->position(), event->modifiers());
  // An outline may begin on a measurement.
  const bool isHand = event->button() == Qt::LeftButton && tool == tool_ && tool != &toolNamed("scissors");
  if (isHand) drag_ = pressMeasurement(press);
  if (!drag_) {
    auto begun = tool->inScene(press);
    (begun && begun->drawing() ? shape_ : drag_) = std::move(begun);
  }
  if (shape_ && !drag_ && tool->draws()) shapePressed_ = true;
  if (shape_) redraw();
}

void VolumeView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) {
    drag_->moveTo(event->position(), event->modifiers());
    if (drag_->drawsOver()) redraw();
  } else if (shape_) {
    shape_->moveTo(event->position(), event->modifiers());
    redraw();
  } else {
    showCursorAt(event->position());
  }
  pointAt(event->position());
}

void VolumeView::letGo() {
  if (!drag_ && !shape_) return;
  drag_.reset();
  shape_.reset();
  session_.endGesture();
  redraw();
}

void VolumeView::giveUp() {
  // A shape being drawn is no undo step yet. Undo steps since its first point are of the camera and stay.
  if (!drag_) return letGo();
  drag_.reset();
  session_.endGesture();
  redraw();
  while (session_.undoStack().index() > stepsAtPress_) session_.undoStack().undo();
}

void VolumeView::mouseReleaseEvent(QMouseEvent* event) {
  if (drag_ && event->button() != dragButton_) return;
  if (shape_ && event->button() == Qt::LeftButton)
    return std::exchange(shapePressed_, false) ? releaseShape(*event) : void();
  const bool isStill = (event->position() - pressedAt_).manhattanLength() < 3;
  const bool clicked = drag_ && drag_->pointsWhereStill() && isStill && !pressedShape_;
  const bool clickedFree = drag_ && isStill && pressedFree_;
  const bool wantsMenu =
      event->button() == Qt::RightButton && isStill && !shape_ && (drag_ || (series() && !toolFor(*event)));
  // A cut may replace the volume, which ends drags.
  if (const auto drag = std::move(drag_)) {
    drag->release(event->position(), event->modifiers());
    session_.endGesture();
    redraw();
  }
  if (clickedFree) session_.select(0);
  if (wantsMenu) Q_EMIT menuRequested(event->globalPosition().toPoint());
  if (!clicked || isChosenByPress_ || !planesOnScreen()) return;
  const std::optional<Pick> hit = pickAt(event->position());
  if (!hit || !hit->pPatient) return;
  const Workspace before = session_.workspace();
  moveCrosshair(session_, id(), *series(), tr("Crosshair"), *hit->pPatient);
  session_.endGesture();
  if (session_.workspace() != before) beforePick_ = before;
}

// The first click of a double-click moved the crosshair unintentionally; its undo step is removed.
void VolumeView::takePickBack() {
  const auto before = std::exchange(beforePick_, {});
  const int steps = session_.undoStack().index();
  if (before && steps == stepsAtPress_ + 1)
    session_.playOn(steps - 1, [&] { session_.change(tr("Crosshair"), *before); });
}

void VolumeView::wheelEvent(QWheelEvent* event) {
  pointAt(event->position());
  if (!series() || drag_) return;
  const MouseSlot slot{MousePlace::scene, MouseInput::wheel, heldOf(event->modifiers())};
  const std::string bound = boundTo(session_.preferences(), slot);
  if (bound == "none") return;
  wheelEnd_.start();
  // A wheel reports no pixels to pan by.
  if (bound == "pan" && !event->pixelDelta().isNull()) {
    const ScenePress press = pressAt(event->position(), {});
    return beginScenePan(press)->moveTo(press.at + event->pixelDelta(), {});
  }
  // Alt makes a wheel horizontal on some systems.
  const QPoint delta = event->angleDelta();
  const double notches = (slot.held == Qt::AltModifier ? delta.x() + delta.y() : delta.y()) / 120.0;
  zoomAt(event->position(), std::pow(0.85, session_.preferences().wheelInverted ? -notches : notches));
}

// Zooms about the point seen there. `factor` scales the visible height.
void VolumeView::zoomAt(QPointF position, double factor) {
  const Camera now = camera();
  const std::optional<Pick> hit = pickAt(position);
  const SightLine line = sightLine(now, size(), toVec(position));
  const std::optional<glm::dvec3> place = hit ? hit->pPatient : std::nullopt;
  glm::dvec3 fixed = place.value_or(line.origin);
  if (!place && now.projection == Projection::perspective)
    fixed = line.origin + now.distance * line.direction;
  editCamera(tr("Zoom"), zoomedAt(now, fixed, factor));
}

// Two fingers moving apart zoom in.
bool VolumeView::event(QEvent* event) {
  if (event->type() != QEvent::NativeGesture) return View::event(event);
  const auto& gesture = static_cast<QNativeGestureEvent&>(*event);
  if (gesture.gestureType() != Qt::ZoomNativeGesture || !series() || drag_) return View::event(event);
  zoomAt(gesture.position(), 1 / std::clamp(1 + gesture.value(), 0.1, 10.0));
  wheelEnd_.start();
  event->accept();
  return true;
}

void VolumeView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && (drag_ || shape_)) return giveUp();
  if (pressMeasuringKey(*event)) return;
  const int right = (event->key() == Qt::Key_Right) - (event->key() == Qt::Key_Left);
  const int down = (event->key() == Qt::Key_Down) - (event->key() == Qt::Key_Up);
  if (!series() || (right == 0 && down == 0)) return View::keyPressEvent(event);
  const double angle = (event->modifiers() & Qt::ShiftModifier ? 1 : 5) * 3.14159265358979 / 180;
  const Camera now = camera();
  editCamera(tr("Rotate"), orbited(now, *now.target, right * angle, down * angle));
  if (!event->isAutoRepeat()) session_.endGesture();
}

}  // namespace volumen
