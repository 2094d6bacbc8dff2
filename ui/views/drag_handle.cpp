#include "ui/views/drag_handle.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>

#include "ui/views/cine_bar.h"
#include "ui/views/stack_bar.h"
#include "ui/views/view.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int handleSide = 22, handleGap = 6;  // logical pixels

}  // namespace

DragHandle::DragHandle(View& view) : QWidget(&view), view_(view) {
  setObjectName(QStringLiteral("dragHandle"));
  setAccessibleName(tr("Drag the picture out"));
  setToolTip(toolTipOf(
      tr("Drag this arrow to a folder or to another program, which then gets the picture as a PNG file.")));
  setCursor(Qt::OpenHandCursor);
  setFixedSize(handleSide, handleSide);
  hide();
  view.installEventFilter(this);
}

bool DragHandle::eventFilter(QObject* view, QEvent* event) {
  const QEvent::Type type = event->type();
  if (type == QEvent::Leave || type == QEvent::Hide) hide();
  if (type == QEvent::Resize) place();
  if (type == QEvent::MouseMove && static_cast<QMouseEvent*>(event)->buttons() == Qt::NoButton) {
    place();
    setVisible(!view_.state().series.empty());
  }
  return QWidget::eventFilter(view, event);
}

// Stands beside the bar of the stack, above the lowest text at the right and the bar that plays.
void DragHandle::place() {
  const int below = CineBar::barHeight + view_.fontMetrics().height() + 2 * handleGap;
  move(view_.width() - StackBar::edge - handleGap - width(), view_.height() - below - height());
}

// Draws an arrow that leaves a frame. The colours are the same in both themes because it lies on the picture.
void DragHandle::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(27, 30, 34, 210));
  painter.drawRoundedRect(rect(), 3, 3);
  painter.setPen(QPen(QColor(0xf2, 0xf4, 0xf6), 1.5));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(QPolygonF({{10, 6.5}, {5, 6.5}, {5, 17}, {15.5, 17}, {15.5, 12}}));
  painter.drawLine(QPointF(10, 12), QPointF(17, 5));
  painter.drawPolyline(QPolygonF({{12.5, 5}, {17, 5}, {17, 9.5}}));
}

void DragHandle::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) pressedAt_ = event->position();
}

void DragHandle::mouseMoveEvent(QMouseEvent* event) {
  if (!pressedAt_ || (event->position() - *pressedAt_).manhattanLength() < QApplication::startDragDistance())
    return;
  pressedAt_.reset();
  hide();  // the pointer leaves the view
  Q_EMIT dragged();
}

// The view gets no release without its press.
void DragHandle::mouseReleaseEvent(QMouseEvent*) { pressedAt_.reset(); }

}  // namespace volumen
