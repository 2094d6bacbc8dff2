#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/tools/tool.h"
#include "ui/views/volume_view.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {
glm::dvec2 toVec(QPointF p) { return {p.x(), p.y()}; }
}  // namespace

const Tool* VolumeView::toolFor(const QMouseEvent& event) const {
  const Preferences& wanted = session_.preferences();
  const auto toolOf = [](DragAction action) { return &toolNamed(nameOf(action)); };
  const Tool* curve = &toolNamed("curve");
  switch (event.button()) {
    case Qt::MiddleButton:
      return toolOf(wanted.middleDrag);
    case Qt::RightButton:
      return toolOf(wanted.rightDrag);
    case Qt::LeftButton:
      // In projections Shift makes the window fine.
      if (tool_ == curve && scene().mode != Mode::composite) return curve;
      return event.modifiers() & Qt::ShiftModifier ? toolOf(wanted.shiftDrag) : tool_;
    default:
      return nullptr;
  }
}

ScenePress VolumeView::pressAt(const QMouseEvent& event) {
  const std::optional<Pick> hit = pickAt(event.position());
  ScenePress press{session_,
                   id(),
                   series(),
                   scene(),
                   event.position(),
                   size(),
                   event.modifiers(),
                   hit ? hit->pPatient : std::nullopt,
                   [this](const QString& text, const Camera& camera) { editCamera(text, camera); },
                   [this](const Lasso& lasso) { Q_EMIT lassoDrawn(state().series, lasso); }};
  press.scene.camera = camera();
  return press;
}

void VolumeView::mousePressEvent(QMouseEvent* event) {
  View::mousePressEvent(event);
  if (!series() || drag_) return;
  const Tool* tool = toolFor(*event);
  if (!tool) return;
  session_.endGesture();
  pressedAt_ = event->position();
  stepsAtPress_ = session_.undoStack().index();
  drag_ = tool->inScene(pressAt(*event));
}

void VolumeView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) {
    drag_->moveTo(event->position(), event->modifiers());
    if (drag_->drawsOver()) canvas_->update();
  }
  pointAt(event->position());
}

void VolumeView::letGo() {
  if (!drag_) return;
  drag_.reset();
  session_.endGesture();
  canvas_->update();
}

void VolumeView::giveUp() {
  const int steps = stepsAtPress_;
  letGo();
  while (session_.undoStack().index() > steps) session_.undoStack().undo();
}

void VolumeView::mouseReleaseEvent(QMouseEvent* event) {
  const bool isStill = (event->position() - pressedAt_).manhattanLength() < 3;
  const bool clicked = drag_ && drag_->pointsWhereStill() && isStill;
  const bool wantsMenu = drag_ && event->button() == Qt::RightButton && isStill;
  // What is cut may exchange the volume, which gives up drags.
  if (const auto drag = std::move(drag_)) {
    drag->release(event->position(), event->modifiers());
    session_.endGesture();
    canvas_->update();
  }
  if (wantsMenu) Q_EMIT menuRequested(event->globalPosition().toPoint());
  if (!clicked || !planesOnScreen()) return;
  const std::optional<Pick> hit = pickAt(event->position());
  if (!hit || !hit->pPatient) return;
  moveCrosshair(session_, id(), *series(), tr("Crosshair"), *hit->pPatient);
  session_.endGesture();
}

void VolumeView::wheelEvent(QWheelEvent* event) {
  pointAt(event->position());
  if (!series() || drag_) return;
  const Camera now = camera();
  const std::optional<Pick> hit = pickAt(event->position());
  const SightLine line = sightLine(now, size(), toVec(event->position()));
  const std::optional<glm::dvec3> place = hit ? hit->pPatient : std::nullopt;
  glm::dvec3 fixed = place.value_or(line.origin);
  if (!place && now.projection == Projection::perspective)
    fixed = line.origin + now.distance * line.direction;
  const double notches = (session_.preferences().wheelInverted ? -1 : 1) * event->angleDelta().y() / 120.0;
  editCamera(tr("Zoom"), zoomedAt(now, fixed, std::pow(0.85, notches)));
  wheelEnd_.start();
}

void VolumeView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && drag_) return giveUp();
  const int right = (event->key() == Qt::Key_Right) - (event->key() == Qt::Key_Left);
  const int down = (event->key() == Qt::Key_Down) - (event->key() == Qt::Key_Up);
  if (!series() || (right == 0 && down == 0)) return QWidget::keyPressEvent(event);
  const double angle = (event->modifiers() & Qt::ShiftModifier ? 1 : 5) * 3.14159265358979 / 180;
  const Camera now = camera();
  editCamera(tr("Rotate"), orbited(now, *now.target, right * angle, down * angle));
  if (!event->isAutoRepeat()) session_.endGesture();
}

}  // namespace volumen
