#include <QPainter>
#include <glm/geometric.hpp>

#include "ui/views/cine_bar.h"
#include "ui/views/colour_bar.h"
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

// Hidden copies, which draw pictures for files, show no drags of other views.
void FlatView::paintDrags(QPainter& painter) const {
  if (drag_) drag_->paint(painter, size());
  if (!isVisible()) return;
  for (const ViewId id : viewsOnScreen(session_.workspace())) {
    const FlatView* view = find_(id);
    if (view && view->drag_ && view->drag_->drawsInAll()) view->drag_->paintIn(painter, *pressAt({}));
  }
}

// Paints everything that lies over the picture.
void FlatView::paintOver(QPainter& painter) const {
  paintLines(painter);
  paintReferenceLines(painter, referenceLines(), rect());
  paintMeasurements(painter, drawnMeasurements());
  paintDrags(painter);
  paintOverlays(painter, overlays(), overlayArea());
  paintColourBar(painter);
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
  if (colourBarOf(session_, id())) paintBarHandles(painter, rect());
  paintLens(painter);
  paintTool(painter);
  paintFocus(painter);
}

}  // namespace volumen
