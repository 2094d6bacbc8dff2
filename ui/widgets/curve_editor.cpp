#include "ui/widgets/curve_editor.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>
#include <utility>

#include "ui/widgets/tissues.h"
#include "viewer/scene/curve_edits.h"

namespace volumen {

namespace {
constexpr double rightMargin = 10;
constexpr int lowestPlot = 80;
constexpr double rampTop = 8, rampHeight = 12;                  // below the plot
constexpr double pointReach = 8, snapReach = 4;                 // pixels
constexpr double flagWidth = 9, flagHeight = 11, endReach = 4;  // of range ends
}  // namespace

CurveEditor::CurveEditor(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);  // the cursor shape shows what can be dragged
  setAccessibleName(tr("Opacity and colour curve"));
  setAccessibleDescription(
      tr("Tab walks the points, arrows move the selected one, Delete removes it, double-click adds one."));
}

void CurveEditor::setCurve(const TransferFunction& curve) {
  if (curve == curve_) return;
  curve_ = curve;
  if (selected_ >= int(curve_.points.size())) select(-1);
  update();
}

void CurveEditor::setHistogram(const Histogram& histogram, const QString& unit) {
  histogram_ = histogram;
  unit_ = unit;
  showAllValues();
}

void CurveEditor::setOpacityScale(OpacityScale scale) {
  scale_ = scale;
  update();
}

void CurveEditor::setWindow(bool window) {
  if (window == window_) return;
  window_ = window;
  select(-1);
  setAccessibleName(window ? tr("Window") : tr("Opacity and colour curve"));
  update();
}

QString CurveEditor::axisName() const {
  if (window_) return tr("Brightness");
  if (scale_ == OpacityScale::extinction) return tr("Extinction per mm");
  return curve_.unitDistance == 1 ? tr("Opacity per mm") : tr("Opacity per %1 mm").arg(curve_.unitDistance);
}

void CurveEditor::setRange(const std::optional<ValueRange>& range) {
  if (range == range_) return;
  range_ = range;
  if (!range_ && drag_ == Drag::rangeEnd) drag_ = Drag::none;
  update();
}

void CurveEditor::select(int n) {
  if (n == selected_) return;
  selected_ = n;
  update();
  Q_EMIT selectionChanged(n);
}

void CurveEditor::showValues(double low, double high) {
  if (!(high > low)) high = low + 1;
  const double smallest = 1e-6 * std::max({1e-3, std::abs(low), std::abs(high)});
  if (high - low < smallest) return;
  low_ = low;
  high_ = high;
  update();
}

void CurveEditor::showAllValues() { showValues(histogram_.low, histogram_.high); }

QFont CurveEditor::smallFont() const {
  QFont small = font();
  small.setPointSizeF(std::max(7.0, small.pointSizeF() - 1.5));
  return small;
}

QSize CurveEditor::minimumSizeHint() const {
  const QRectF plot = plotRect();
  return {220, int(height() - plot.height()) + lowestPlot};
}

QRectF CurveEditor::plotRect() const {
  const QFontMetricsF metrics(smallFont());
  const double left = metrics.horizontalAdvance(QStringLiteral("0.00001")) + 8,
               top = 1.5 * metrics.height() + 4;
  const double below = rampTop + rampHeight + metrics.height() + 8;
  return {left, top, std::max(1.0, width() - left - rightMargin), std::max(1.0, height() - top - below)};
}

ValueAxis CurveEditor::valueAxis() const {
  const QRectF plot = plotRect();
  return {low_, high_, plot.left(), plot.right()};
}

OpacityAxis CurveEditor::opacityAxis() const {
  const QRectF plot = plotRect();
  return {opacityScale(), curve_.unitDistance, plot.bottom(), plot.top()};
}

QPointF CurveEditor::positionOf(int n) const {
  const CurvePoint& p = curve_.points[n];
  return {valueAxis().pixelOf(p.value), opacityAxis().pixelOf(p.opacity)};
}

QRectF CurveEditor::swatchOf(int n) const {
  const double x = valueAxis().pixelOf(curve_.points[n].value);
  return {x - 5, plotRect().bottom() + rampTop - 1, 10, rampHeight + 2};
}

int CurveEditor::pointAt(QPointF position) const {
  int nearest = -1;
  double distance = pointReach;
  for (int n = 0; n < int(curve_.points.size()); ++n) {
    const QPointF d = positionOf(n) - position;
    const double length = std::hypot(d.x(), d.y());
    if (length > distance) continue;
    distance = length;
    nearest = n;
  }
  return nearest;
}

int CurveEditor::swatchAt(QPointF position) const {
  for (int n = int(curve_.points.size()) - 1; n >= 0; --n)
    if (swatchOf(n).contains(position)) return n;
  return -1;
}

// Flags are above the plot on the outer side of each end: if both ends coincide, either can be taken.
QRectF CurveEditor::rangeHandle(int end) const {
  const double x = valueAxis().pixelOf(endOfRange(end));
  return {end == 0 ? x - flagWidth : x, plotRect().top() - flagHeight, flagWidth, flagHeight};
}

// Returns the end whose flag or line is at a position; -1: none.
int CurveEditor::rangeEndAt(QPointF position) const {
  if (!range_) return -1;
  const QRectF plot = plotRect();
  const auto isInView = [&](int end) {
    const double x = valueAxis().pixelOf(endOfRange(end));
    return x >= plot.left() - 1 && x <= plot.right() + 1;
  };
  for (int end : {0, 1})
    if (isInView(end) && rangeHandle(end).contains(position)) return end;
  if (position.y() < plot.top() || position.y() > plot.bottom()) return -1;
  int nearest = -1;
  double distance = endReach;
  for (int end : {0, 1}) {
    const double away = std::abs(valueAxis().pixelOf(endOfRange(end)) - position.x());
    if (!isInView(end) || away >= distance) continue;
    distance = away;
    nearest = end;
  }
  return nearest;
}

void CurveEditor::dragRangeTo(double pixel) {
  const double value = snapped(valueAxis().valueAt(endAtPress_ + pixel - pressedAt_.x()));
  if (draggedEnd_ == 0)
    range_->low = std::min(value, range_->high);
  else
    range_->high = std::max(value, range_->low);
  update();
  const ValueRange dragged = *range_;  // a receiver may set another range
  Q_EMIT rangeDragged(dragged, false);
}

QString CurveEditor::moveText() const { return window_ ? tr("Window") : tr("Move curve point"); }

void CurveEditor::change(TransferFunction curve, const QString& what) {
  curve_ = std::move(curve);
  update();
  Q_EMIT edited(curve_, what);
}

void CurveEditor::mousePressEvent(QMouseEvent* event) {
  const int hit = pointAt(event->position());
  pressedAt_ = event->position();
  if (event->button() == Qt::RightButton) {
    if (hit >= 0 && !window_) removePoint(hit);
    return;
  }
  if (const int swatch = window_ ? -1 : swatchAt(event->position());
      swatch >= 0 && event->button() == Qt::LeftButton) {
    select(swatch);
    Q_EMIT colourRequested(swatch);
    return;
  }
  const int end = rangeEndAt(event->position());
  const bool isAbovePoints = event->position().y() < plotRect().top() - pointReach / 2;
  if (end >= 0 && (hit < 0 || isAbovePoints) && event->button() == Qt::LeftButton) {
    drag_ = Drag::rangeEnd;
    draggedEnd_ = end;
    endAtPress_ = valueAxis().pixelOf(endOfRange(end));
    return;
  }
  select(hit);
  drag_ = hit >= 0 && event->button() == Qt::LeftButton ? Drag::point : Drag::pan;
  axisAtPress_ = valueAxis();
  if (hit >= 0) pointAtPress_ = positionOf(hit);
}

void CurveEditor::mouseMoveEvent(QMouseEvent* event) {
  if (drag_ == Drag::point && selected_ >= 0) dragPointTo(event->position(), event->modifiers());
  if (drag_ == Drag::rangeEnd) dragRangeTo(event->position().x());
  if (drag_ == Drag::none && rangeEndAt(event->position()) >= 0)
    setCursor(Qt::SplitHCursor);
  else if (drag_ == Drag::none)
    unsetCursor();
  if (drag_ == Drag::pan) {
    const ValueAxis axis = axisAtPress_.panned(event->position().x() - pressedAt_.x());
    showValues(axis.low, axis.high);
  }
}

void CurveEditor::mouseReleaseEvent(QMouseEvent*) {
  const Drag ended = std::exchange(drag_, Drag::none);
  if (ended == Drag::point) Q_EMIT gestureFinished();
  if (ended != Drag::rangeEnd) return;
  const ValueRange dragged = *range_;
  Q_EMIT rangeDragged(dragged, true);
}

void CurveEditor::dragPointTo(QPointF position, Qt::KeyboardModifiers modifiers) {
  QPointF moved = position - pressedAt_;
  if (modifiers & Qt::ShiftModifier) {
    if (std::abs(moved.x()) > std::abs(moved.y()))
      moved.setY(0);
    else
      moved.setX(0);
  }
  const QPointF to = pointAtPress_ + moved;
  const CurvePoint& point = curve_.points[selected_];
  const double value = moved.x() == 0 ? double(point.value) : snapped(valueAxis().valueAt(to.x()));
  const double opacity = moved.y() == 0 || window_ ? point.opacity : opacityAxis().opacityAt(to.y());
  change(withPointMoved(curve_, selected_, value, opacity), moveText());
}

double CurveEditor::snapped(double value) const {
  if (unit_ != QStringLiteral("HU")) return value;
  for (const Tissue& tissue : tissuesHu)
    if (std::abs(tissue.value - value) < snapReach * valueAxis().valuesPerPixel()) return tissue.value;
  return value;
}

void CurveEditor::mouseDoubleClickEvent(QMouseEvent* event) {
  if (window_ || event->button() != Qt::LeftButton || pointAt(event->position()) >= 0 ||
      rangeEndAt(event->position()) >= 0)
    return;
  const QRectF plot = plotRect();
  if (!plot.adjusted(0, -pointReach, 0, pointReach).contains(event->position())) return;
  int added = -1;
  TransferFunction curve = withPointAdded(curve_, valueAxis().valueAt(event->position().x()),
                                          opacityAxis().opacityAt(event->position().y()), &added);
  change(std::move(curve), tr("Add curve point"));
  select(added);
  pressedAt_ = event->position();
  pointAtPress_ = positionOf(added);
  drag_ = Drag::point;
}

void CurveEditor::removePoint(int n) {
  if (curve_.points.size() < 2) return;
  select(-1);
  change(withPointRemoved(curve_, n), tr("Remove curve point"));
  Q_EMIT gestureFinished();
}

void CurveEditor::wheelEvent(QWheelEvent* event) {
  const double notches = event->angleDelta().y() / 120.0;
  const ValueAxis axis = valueAxis().zoomedAt(event->position().x(), std::pow(0.8, notches));
  showValues(axis.low, axis.high);
  event->accept();
}

void CurveEditor::nudge(double pixelsRight, double pixelsUp) {
  const CurvePoint& point = curve_.points[selected_];
  const double value = point.value + pixelsRight * valueAxis().valuesPerPixel();
  double opacity = point.opacity;
  if (pixelsUp != 0 && !window_) {
    // A point enters or leaves the strip for 0 in one step.
    const OpacityAxis axis = opacityAxis();
    opacity = axis.opacityAt(axis.pixelOf(opacity) - pixelsUp);
    if (scale_ == OpacityScale::extinction && pixelsUp > 0 && opacity == 0)
      opacity = opacityFromExtinction(OpacityAxis::lowestExtinction, curve_.unitDistance);
  }
  change(withPointMoved(curve_, selected_, value, opacity), moveText());
}

void CurveEditor::keyPressEvent(QKeyEvent* event) {
  const double pixels = event->modifiers() & Qt::ShiftModifier ? 0.2 : 2;
  const bool any = selected_ >= 0;
  if (event->key() == Qt::Key_Home)
    showAllValues();
  else if (any && event->key() == Qt::Key_Left)
    nudge(-pixels, 0);
  else if (any && event->key() == Qt::Key_Right)
    nudge(pixels, 0);
  else if (any && event->key() == Qt::Key_Up)
    nudge(0, pixels);
  else if (any && event->key() == Qt::Key_Down)
    nudge(0, -pixels);
  else if (any && !window_ && (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace))
    removePoint(selected_);
  else if (any && event->key() == Qt::Key_Escape)
    select(-1);
  else
    QWidget::keyPressEvent(event);
}

void CurveEditor::keyReleaseEvent(QKeyEvent* event) {
  if (!event->isAutoRepeat()) Q_EMIT gestureFinished();
  QWidget::keyReleaseEvent(event);
}

bool CurveEditor::event(QEvent* event) {
  // Tab selects the next point and leaves the widget after the last one.
  if (event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const int next = key->key() == Qt::Key_Tab       ? selected_ + 1
                     : key->key() == Qt::Key_Backtab ? selected_ - 1
                                                     : -1;
    if (next >= 0 && next < int(curve_.points.size())) {
      select(next);
      return true;
    }
  }
  return QWidget::event(event);
}

}  // namespace volumen
