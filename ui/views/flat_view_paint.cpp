#include <QPainter>
#include <glm/geometric.hpp>

#include "ui/views/cine_bar.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/flat_view.h"
#include "ui/views/reference_lines.h"
#include "ui/widgets/warning_badge.h"

namespace volumen {

Overlays FlatView::cornersOf(const CornerTexts& texts) const {
  const int lines = cornerLines(overlayArea(), font());
  Overlays o;
  o.topLeft = texts.left(lines);
  o.topRight = texts.right(lines);
  o.date = dateBeside();
  if (badge_->isVisibleTo(this)) o.taken.push_back(badge_->geometry());
  return o;
}

// The bar is at the bottom; texts stand above it.
void FlatView::placeCineBar() {
  cine_->setGeometry(0, height() - CineBar::barHeight, width(), CineBar::barHeight);
}

QRectF FlatView::overlayArea() const {
  return QRectF(rect()).adjusted(0, 0, -6, cine_->isHidden() ? 0 : -CineBar::barHeight);
}

std::vector<QWidget*> FlatView::badges() const {
  std::vector<QWidget*> all = View::badges();
  all.push_back(badge_);
  return all;
}

// Letters and measurements would be wrong over a picture in another orientation.
bool FlatView::liesAsDrawn() const {
  const std::optional<SlicePlane> now = plane();
  if (!now || !drawn_) return true;
  return glm::dot(now->right, drawn_->plane.right) > 0.5 && glm::dot(now->down, drawn_->plane.down) > 0.5;
}

void FlatView::paintShown(QPainter& painter) const {
  paintWith(painter, liesAsDrawn() ? picture_ : QImage());
}

void FlatView::paintWith(QPainter& painter, const QImage& picture) const {
  painter.fillRect(rect(), Qt::black);
  if (shown()) {
    if (!picture.isNull()) painter.drawImage(QPointF(0, 0), picture);
    paintOver(painter);
  } else if (isLoading()) {
    if (!picture.isNull()) painter.drawImage(QPointF(0, 0), picture);
    paintOverlays(painter, waitingOverlays(), overlayArea());
  } else if (const QString sentence = failure(); !sentence.isEmpty()) {
    Overlays only;
    only.warning = sentence;
    paintOverlays(painter, only, rect());
  }
}

void FlatView::showBall(const std::optional<DrawnBall>& ball) {
  ball_ = ball;
  update();
}

// A sphere of another frame of reference is drawn where the registration puts it.
void FlatView::paintDrawnBall(QPainter& painter) const {
  if (!ball_ || shapeFrame()) return;
  const Workspace& workspace = session_.workspace();
  const auto of = workspace.series.find(ball_->series);
  if (of == workspace.series.end()) return;
  const auto relation =
      relationOf(workspace, frameOfReference(*of->second.series), frameOfReference(shown()->series));
  if (!relation) return;
  paintBall(painter, *plane(), devicePixelRatioF(), relation->toFromFrom(ball_->pPatient), ball_->radiusMm);
}

// Paints everything that lies over the picture.
void FlatView::paintOver(QPainter& painter) const {
  paintLines(painter);
  paintReferenceLines(painter, referenceLines(), rect());
  paintMeasurements(painter, drawnMeasurements());
  paintDrawnBall(painter);
  if (drag_) drag_->paint(painter, size());
  paintOverlays(painter, overlays(), overlayArea());
  paintColours(painter);
}

// The tool is painted above everything, at the pointer.
void FlatView::paintTool(QPainter& painter) const {
  if (!tool_->paintAt || !pointedAt()) return;
  if (const auto press = pressAt(*pointedAt())) tool_->paintAt(painter, *press);
}

void FlatView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paintShown(painter);
  if (const std::optional<StackBar> bar = stackBar()) bar->paint(painter);
  if (shown()) paintHandles(painter);
  paintLens(painter);
  paintTool(painter);
  paintFocus(painter);
}

}  // namespace volumen
