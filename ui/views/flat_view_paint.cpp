#include <QPainter>
#include <glm/geometric.hpp>

#include "ui/views/drawn_measurement.h"
#include "ui/views/flat_view.h"
#include "ui/views/time_bar.h"
#include "ui/widgets/warning_badge.h"

namespace volumen {

Overlays FlatView::cornersOf(const CornerTexts& texts) const {
  const int lines = cornerLines(overlayArea(), font());
  Overlays o;
  o.topLeft = texts.left(lines);
  o.topRight = texts.right(lines);
  if (badge_->isVisibleTo(this)) o.taken.push_back(badge_->geometry());
  return o;
}

// At the bottom; what is written stands above it.
void FlatView::placeTimeBar() {
  constexpr int height = 20;
  time_->setGeometry(8, this->height() - height, width() - 20, height);
}

QRectF FlatView::overlayArea() const {
  return QRectF(rect()).adjusted(0, 0, -6, time_->hasSteps() ? -time_->height() : 0);
}

void FlatView::paintStackBar(QPainter& painter) const {
  const StackPlace place = this->place();
  if (place.count < 2) return;
  const QRectF bar(width() - 5.0, 0, 3, height());
  const double part = bar.height() / place.count;
  painter.fillRect(bar, QColor(255, 255, 255, 30));
  painter.fillRect(QRectF(bar.x(), place.index * part, bar.width(), std::max(3.0, part)),
                   QColor(255, 255, 255, 140));
}

std::vector<QWidget*> FlatView::badges() const {
  std::vector<QWidget*> all = View::badges();
  all.push_back(badge_);
  return all;
}

// Beside a picture that is turned otherwise no letter and no measurement would be right.
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
    paintLines(painter);
    paintMeasurements(painter, drawnMeasurements());
    paintOverlays(painter, overlays(), overlayArea());
    paintColours(painter);
  } else if (isWaiting()) {
    painter.drawImage(QPointF(0, 0), picture);
    paintOverlays(painter, waitingOverlays(), overlayArea());
  } else if (const QString sentence = failure(); !sentence.isEmpty()) {
    Overlays only;
    only.warning = sentence;
    paintOverlays(painter, only, rect());
  }
}

void FlatView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paintShown(painter);
  if (shown()) {
    paintStackBar(painter);
    paintHandles(painter);
  }
  paintFocus(painter);
}

}  // namespace volumen
