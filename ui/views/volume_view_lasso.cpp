#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <glm/geometric.hpp>

#include "ui/views/volume_view.h"

namespace volumen {

namespace {

constexpr double leastStep = 2;  // logical pixels between two points of an outline
constexpr std::size_t fewestPoints = 3;

QPainterPath pathOf(const std::vector<glm::dvec2>& outline) {
  QPainterPath path({outline.front().x, outline.front().y});
  for (const glm::dvec2 p : outline) path.lineTo(p.x, p.y);
  path.closeSubpath();
  path.setFillRule(Qt::WindingFill);
  return path;
}

}  // namespace

void VolumeView::moveLasso(const QMouseEvent& event) {
  const glm::dvec2 p(event.position().x(), event.position().y());
  cutsInside_ = !(event.modifiers() & Qt::ControlModifier);
  if (glm::distance(p, outline_.back()) >= leastStep) outline_.push_back(p);
  canvas_->update();
}

void VolumeView::endLasso(const QMouseEvent& event) {
  moveLasso(event);
  if (outline_.size() < fewestPoints) return;
  Lasso lasso = lassoOf(cameraAtPress_, size(), outline_);
  lasso.inside = cutsInside_;
  Q_EMIT lassoDrawn(state().series, lasso);
}

void VolumeView::letGo() {
  if (hand_ == Hand::none) return;
  hand_ = Hand::none;
  outline_.clear();
  session_.endGesture();
  canvas_->update();
}

void VolumeView::giveUp() {
  const int steps = stepsAtPress_;
  letGo();
  while (session_.undoStack().index() > steps) session_.undoStack().undo();
}

// What is to go is shaded.
void VolumeView::paintLasso(QPainter& painter) const {
  if (outline_.empty()) return;
  const QPainterPath drawn = pathOf(outline_);
  QPainterPath all;
  all.addRect(rect());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillPath(cutsInside_ ? drawn : all.subtracted(drawn), QColor(255, 80, 70, 60));
  for (const auto& [colour, width] :
       {std::pair(QColor(Qt::black), 3.0), std::pair(QColor(0xff, 0x8a, 0x80), 1.4)})
    painter.strokePath(drawn, QPen(colour, width));
  painter.setRenderHint(QPainter::Antialiasing, false);
}

}  // namespace volumen
