#include "ui/widgets/light_ball.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "ui/widgets/colours.h"

namespace volumen {

namespace {
constexpr double handleRadius = 6, handleReach = 10;  // pixels
}

LightBall::LightBall(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Light directions"));
  setToolTip(tr("Drag a handle to move its light; double-click to send it behind the object."));
}

void LightBall::setLights(std::vector<BallLight> lights) {
  if (lights == lights_) return;
  lights_ = std::move(lights);
  sphere_ = {};
  if (selected_ >= int(lights_.size())) select(int(lights_.size()) - 1);
  update();
}

void LightBall::select(int n) {
  if (n == selected_) return;
  selected_ = n;
  update();
  Q_EMIT selectionChanged(n);
}

QPointF LightBall::centre() const { return {width() / 2.0, height() / 2.0}; }

double LightBall::radius() const {
  return std::max(10.0, std::min(width(), height()) / 2.0 - handleRadius - 4);
}

QPointF LightBall::positionOf(glm::dvec3 direction) const {
  return centre() + QPointF(direction.x, -direction.y) * radius();
}

glm::dvec3 LightBall::directionAt(QPointF position, bool behind) const {
  const QPointF p = (position - centre()) / radius();
  glm::dvec3 d(p.x(), -p.y(), 0);
  double r = std::hypot(d.x, d.y);
  if (r > 1) {
    const double folded = std::max(0.0, 2 - r);
    d *= folded / r;
    r = folded;
    behind = !behind;
  }
  d.z = std::sqrt(std::max(0.0, 1 - r * r)) * (behind ? -1 : 1);
  return glm::normalize(d);
}

int LightBall::lightAt(QPointF position) const {
  int nearest = -1;
  double distance = handleReach;
  bool front = false;
  for (int n = 0; n < int(lights_.size()); ++n) {
    const QPointF d = positionOf(lights_[n].direction) - position;
    const double length = std::hypot(d.x(), d.y());
    const bool inFront = lights_[n].direction.z >= 0;
    if (length > handleReach || (front && !inFront) || (front == inFront && length > distance)) continue;
    nearest = n;
    distance = length;
    front = inFront;
  }
  return nearest;
}

void LightBall::turn(int n, glm::dvec3 direction) {
  lights_[n].direction = direction;
  sphere_ = {};
  update();
  Q_EMIT directionEdited(n, direction);
}

void LightBall::flip(int n) {
  glm::dvec3 d = lights_[n].direction;
  d.z = -d.z;
  turn(n, d);
  Q_EMIT gestureFinished();
}

void LightBall::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const int hit = lightAt(event->position());
  if (hit < 0) return;
  select(hit);
  dragging_ = true;
  dragBehind_ = lights_[hit].direction.z < 0;
  grabOffset_ = positionOf(lights_[hit].direction) - event->position();
}

void LightBall::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_ && selected_ >= 0) turn(selected_, directionAt(event->position() + grabOffset_, dragBehind_));
}

void LightBall::mouseReleaseEvent(QMouseEvent*) {
  if (dragging_) Q_EMIT gestureFinished();
  dragging_ = false;
}

void LightBall::mouseDoubleClickEvent(QMouseEvent* event) {
  const int hit = lightAt(event->position());
  if (hit >= 0 && event->button() == Qt::LeftButton) flip(hit);
}

void LightBall::keyPressEvent(QKeyEvent* event) {
  const int right = (event->key() == Qt::Key_Right) - (event->key() == Qt::Key_Left);
  const int up = (event->key() == Qt::Key_Up) - (event->key() == Qt::Key_Down);
  if (selected_ < 0) return QWidget::keyPressEvent(event);
  if (event->key() == Qt::Key_Space) return flip(selected_);
  if (right == 0 && up == 0) return QWidget::keyPressEvent(event);
  const double angle = glm::radians(event->modifiers() & Qt::ShiftModifier ? 1.0 : 5.0);
  const glm::dvec3 d = lights_[selected_].direction;
  const glm::dvec3 towards =
      right != 0 ? glm::dvec3(d.z, 0, -d.x) * double(right) : glm::dvec3(0, d.z, -d.y) * double(up);
  turn(selected_, glm::normalize(d + towards * std::tan(angle)));
}

void LightBall::keyReleaseEvent(QKeyEvent* event) {
  if (!event->isAutoRepeat()) Q_EMIT gestureFinished();
  QWidget::keyReleaseEvent(event);
}

bool LightBall::event(QEvent* event) {
  if (event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const int next = key->key() == Qt::Key_Tab       ? selected_ + 1
                     : key->key() == Qt::Key_Backtab ? selected_ - 1
                                                     : -1;
    if (next >= 0 && next < int(lights_.size())) {
      select(next);
      return true;
    }
  }
  return QWidget::event(event);
}

void LightBall::resizeEvent(QResizeEvent*) { sphere_ = {}; }

QImage LightBall::shadedSphere() const {
  const int size = int(std::ceil(2 * radius()));
  QImage image(size, size, QImage::Format_ARGB32_Premultiplied);
  for (int y = 0; y < size; ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < size; ++x) {
      glm::dvec3 n((x + 0.5) / size * 2 - 1, 1 - (y + 0.5) / size * 2, 0);
      const double rest = 1 - n.x * n.x - n.y * n.y;
      n.z = std::sqrt(std::max(0.0, rest));
      glm::dvec3 c(0.18);
      for (const BallLight& light : lights_)
        if (light.on) c += 0.6 * light.intensity * light.colour * std::max(0.0, glm::dot(n, light.direction));
      // one pixel of soft rim
      const double alpha = std::clamp((1 - std::hypot(n.x, n.y)) * size / 2 + 0.5, 0.0, 1.0);
      const QColor colour = toQColor(c);
      row[x] = qPremultiply(qRgba(colour.red(), colour.green(), colour.blue(), int(255 * alpha + 0.5)));
    }
  }
  return image;
}

void LightBall::paintEvent(QPaintEvent*) {
  if (sphere_.isNull()) sphere_ = shadedSphere();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.drawImage(centre() - QPointF(radius(), radius()), sphere_);
  painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Highlight : QPalette::Mid), 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(centre(), radius(), radius());
  for (int n = 0; n < int(lights_.size()); ++n) {
    const BallLight& light = lights_[n];
    const QPointF at = positionOf(light.direction);
    const bool behind = light.direction.z < 0;
    QColor fill = toQColor(light.colour);
    if (!light.on) fill = palette().color(QPalette::Mid);
    painter.setPen(QPen(Qt::black, 4));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(at, handleRadius, handleRadius);
    painter.setPen(QPen(n == selected_ ? palette().color(QPalette::Highlight) : QColor(Qt::white), 2));
    painter.setBrush(behind ? QBrush(Qt::NoBrush) : QBrush(fill));
    painter.drawEllipse(at, handleRadius, handleRadius);
  }
}

}  // namespace volumen
