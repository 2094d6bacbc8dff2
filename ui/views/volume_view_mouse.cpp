#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/tools/flat_tool.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/curve_edits.h"
#include "ui/workspace/text.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {
constexpr double turnPerPixel = 0.008;  // rad
glm::dvec2 toVec(QPointF p) { return {p.x(), p.y()}; }
}  // namespace

VolumeView::Hand VolumeView::handOf(DragAction action, bool control) const {
  switch (action) {
    case DragAction::rotate:
      return control ? Hand::roll : Hand::orbit;
    case DragAction::curve:
      if (scene().mode != Mode::composite) return Hand::window;
      return control ? Hand::opacity : Hand::curve;
    case DragAction::pan:
      return Hand::pan;
    case DragAction::zoom:
      return Hand::zoom;
  }
  return Hand::none;
}

VolumeView::Hand VolumeView::handFor(const QMouseEvent& event) const {
  const bool control = event.modifiers() & Qt::ControlModifier, shift = event.modifiers() & Qt::ShiftModifier;
  const Preferences& wanted = session_.preferences();
  switch (event.button()) {
    case Qt::MiddleButton:
      return handOf(wanted.middleDrag, control);
    case Qt::RightButton:
      return handOf(wanted.rightDrag, control);
    case Qt::LeftButton:
      if (tool_ == ViewTool::curve && scene().mode != Mode::composite) return Hand::window;
      if (shift) return handOf(wanted.shiftDrag, control);
      if (tool_ == ViewTool::scissors) return Hand::lasso;
      return handOf(tool_ == ViewTool::curve ? DragAction::curve : DragAction::rotate, control);
    default:
      return Hand::none;
  }
}

void VolumeView::mousePressEvent(QMouseEvent* event) {
  View::mousePressEvent(event);
  if (!series() || hand_ != Hand::none) return;
  hand_ = handFor(*event);
  pressedAt_ = event->position();
  stepsAtPress_ = session_.undoStack().index();
  if (hand_ == Hand::lasso) outline_ = {toVec(pressedAt_)};
  cameraAtPress_ = camera();
  curveAtPress_ = scene().transferFunction;
  windowAtPress_ = windowInUse(scene(), *series());
  const std::optional<Pick> hit = pickAt(pressedAt_);
  const std::optional<glm::dvec3> place = hit ? hit->pPatient : std::nullopt;
  pivot_ = place.value_or(*cameraAtPress_.target);
  if (!place && hand_ == Hand::zoom && cameraAtPress_.projection == Projection::parallel)
    pivot_ = sightLine(cameraAtPress_, size(), toVec(pressedAt_)).origin;
  session_.endGesture();
}

Camera VolumeView::movedCamera(QPointF to) const {
  const QPointF moved = to - pressedAt_;
  switch (hand_) {
    case Hand::orbit:
      return orbited(cameraAtPress_, pivot_, moved.x() * turnPerPixel, moved.y() * turnPerPixel);
    case Hand::roll: {
      const QPointF middle(width() / 2.0, height() / 2.0), a = pressedAt_ - middle, b = to - middle;
      return rolled(cameraAtPress_, std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()));
    }
    case Hand::pan:
      return panned(cameraAtPress_, size(), toVec(moved), pivot_);
    case Hand::zoom:
      return zoomedAt(cameraAtPress_, pivot_,
                      std::exp((session_.preferences().zoomDragInverted ? -0.008 : 0.008) * moved.y()));
    default:
      return cameraAtPress_;
  }
}

TransferFunction VolumeView::movedCurve(QPointF to) const {
  const QPointF part((to.x() - pressedAt_.x()) / width(), (to.y() - pressedAt_.y()) / height());
  if (hand_ == Hand::opacity) return withOpacityScaled(curveAtPress_, std::exp(-6 * part.y()));
  const Histogram& histogram = series()->histogram;
  return shifted(
      widened(curveAtPress_, std::exp(2 * part.x())),
      (session_.preferences().curveDragInverted ? -0.5 : 0.5) * part.y() * (histogram.high - histogram.low));
}

void VolumeView::moveWindow(const QMouseEvent& event) {
  const Qt::KeyboardModifiers keys = event.modifiers();
  const double speed = keys & Qt::ControlModifier ? 5 : keys & Qt::ShiftModifier ? 0.2 : 1;
  const Window moved = draggedWindow(windowAtPress_, speed * toVec(event.position() - pressedAt_), *series());
  const QString what = tr("Window");
  session_.edit(
      id(), what, [&](Scene& s) { s.window = moved; }, what);
}

void VolumeView::mouseMoveEvent(QMouseEvent* event) {
  moveHand(*event);
  pointAt(event->position());
}

void VolumeView::moveHand(const QMouseEvent& event) {
  switch (hand_) {
    case Hand::none:
      return;
    case Hand::curve:
    case Hand::opacity: {
      const QString what = hand_ == Hand::curve ? tr("Adjust curve") : tr("Adjust opacity");
      return session_.edit(
          id(), what, [&](Scene& s) { s.transferFunction = movedCurve(event.position()); }, what);
    }
    case Hand::window:
      return moveWindow(event);
    case Hand::lasso:
      return moveLasso(event);
    case Hand::orbit:
    case Hand::roll:
      return editCamera(tr("Rotate"), movedCamera(event.position()));
    case Hand::pan:
      return editCamera(tr("Pan"), movedCamera(event.position()));
    case Hand::zoom:
      return editCamera(tr("Zoom"), movedCamera(event.position()));
  }
}

void VolumeView::mouseReleaseEvent(QMouseEvent* event) {
  const bool isStill = (event->position() - pressedAt_).manhattanLength() < 3;
  const bool clicked = hand_ == Hand::orbit && isStill;
  const bool wantsMenu = hand_ != Hand::none && event->button() == Qt::RightButton && isStill;
  if (hand_ == Hand::lasso) endLasso(*event);
  letGo();
  if (wantsMenu) Q_EMIT menuRequested(event->globalPosition().toPoint());
  if (!clicked || !planesOnScreen()) return;
  const std::optional<Pick> hit = pickAt(event->position());
  if (!hit || !hit->pPatient) return;
  moveCrosshair(session_, id(), *series(), tr("Crosshair"), *hit->pPatient);
  session_.endGesture();
}

void VolumeView::wheelEvent(QWheelEvent* event) {
  pointAt(event->position());
  if (!series() || hand_ != Hand::none) return;
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
  if (event->key() == Qt::Key_Escape && hand_ != Hand::none) return giveUp();
  const int right = (event->key() == Qt::Key_Right) - (event->key() == Qt::Key_Left);
  const int down = (event->key() == Qt::Key_Down) - (event->key() == Qt::Key_Up);
  if (!series() || (right == 0 && down == 0)) return QWidget::keyPressEvent(event);
  const double angle = (event->modifiers() & Qt::ShiftModifier ? 1 : 5) * 3.14159265358979 / 180;
  const Camera now = camera();
  editCamera(tr("Rotate"), orbited(now, *now.target, right * angle, down * angle));
  if (!event->isAutoRepeat()) session_.endGesture();
}

}  // namespace volumen
