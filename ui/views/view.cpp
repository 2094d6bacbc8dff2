#include "ui/views/view.h"

#include <QDragEnterEvent>
#include <QMouseEvent>
#include <QPainter>
#include <cmath>

namespace volumen {

View::View(Session& session, ViewId id, QWidget* parent)
    : QWidget(parent), session_(session), id_(id), seen_(series()) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAcceptDrops(true);
  session_.setViewSize(id_, {pixels().width(), pixels().height()});
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace& before) {
    const ShownSeriesPtr last = std::exchange(seen_, series());
    if (last != seen_) seriesExchanged(!areOneSeries(last, seen_));
    workspaceChanged(before);
  });
}

QSize View::pixels() const {
  return {int(std::ceil(width() * devicePixelRatioF())), int(std::ceil(height() * devicePixelRatioF()))};
}

void View::paintFocus(QPainter& painter) const {
  if (viewsOnScreen(session_.workspace()).size() < 2 || session_.workspace().focus != id_) return;
  painter.setPen(QColor(0x4a, 0xa3, 0xff));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

// Files are the window's.
void View::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) return event->ignore();
  event->acceptProposedAction();
}

void View::dropEvent(QDropEvent* event) {
  if (event->mimeData()->hasUrls()) return event->ignore();
  event->acceptProposedAction();
  session_.setFocus(id_);
  Q_EMIT dropped(*event->mimeData());
}

void View::mousePressEvent(QMouseEvent* event) {
  session_.setFocus(id_);
  event->accept();
}

void View::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) Q_EMIT maximiseRequested();
}

void View::leaveEvent(QEvent*) { Q_EMIT hovered({}); }

void View::resizeEvent(QResizeEvent*) {
  session_.setViewSize(id_, {pixels().width(), pixels().height()});
  Q_EMIT pixelsChanged();
}

}  // namespace volumen
