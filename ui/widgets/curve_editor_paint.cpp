#include <QLinearGradient>
#include <QPainter>
#include <QPainterPath>
#include <cmath>

#include "ui/widgets/colours.h"
#include "ui/widgets/curve_editor.h"
#include "ui/widgets/tissues.h"
#include "viewer/scene/curve_edits.h"

namespace volumen {

namespace {

constexpr double rampBottom = 22;  // below the plot

QColor faded(QColor colour, double alpha) {
  colour.setAlphaF(float(alpha));
  return colour;
}

// Returns the curve's colours along the axis, with as many stops as QGradient draws well.
QLinearGradient rampOf(const TransferFunction& curve, const ValueAxis& axis, double alpha) {
  QLinearGradient ramp(axis.pixelLow, 0, axis.pixelHigh, 0);
  constexpr int stops = 128;
  for (int n = 0; n <= stops; ++n) {
    const double t = double(n) / stops;
    ramp.setColorAt(t, faded(toQColor(curveAt(curve, axis.low + t * (axis.high - axis.low)).colour), alpha));
  }
  return ramp;
}

QString opacityText(double opacity, const OpacityAxis& axis) {
  if (axis.scale == OpacityScale::linear) return QString::number(opacity, 'g', 2);
  if (opacity == 0) return QStringLiteral("0");
  const double extinction = extinctionPerMm(opacity, axis.unitDistance);  // a power of ten
  return QString::number(extinction, 'f', std::max(0, int(-std::floor(std::log10(extinction) + 0.5))));
}

}  // namespace

void CurveEditor::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(smallFont());
  const QRectF plot = plotRect();
  painter.fillRect(plot, palette().color(QPalette::Base));
  paintHistogram(painter);
  paintGrid(painter);
  paintTissues(painter);
  paintCurve(painter);
  paintRamp(painter);
  paintRange(painter);
  if (hasFocus()) {
    painter.setPen(QPen(palette().color(QPalette::Highlight), 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(plot.adjusted(-0.5, -0.5, 0.5, 0.5));
  }
}

void CurveEditor::paintHistogram(QPainter& painter) const {
  if (histogram_.counts.empty()) return;
  const QRectF plot = plotRect();
  const ValueAxis axis = valueAxis();
  std::int64_t most = 1;
  for (std::int64_t count : histogram_.counts) most = std::max(most, count);
  const int bins = int(histogram_.counts.size());
  const auto binAt = [&](double value) {
    return int(std::floor((value - histogram_.low) / std::max(1e-30, histogram_.binWidth())));
  };
  QPainterPath area(plot.bottomLeft());
  for (double x = plot.left(); x <= plot.right(); ++x) {
    const int first = std::max(0, binAt(axis.valueAt(x - 0.5)));
    const int last = std::min(bins - 1, std::max(first, binAt(axis.valueAt(x + 0.5))));
    std::int64_t count = 0;
    for (int bin = first; bin <= last; ++bin) count = std::max(count, histogram_.counts[bin]);
    const double share = std::log1p(double(count)) / std::log1p(double(most));
    area.lineTo(x, plot.bottom() - share * plot.height() * 0.95);
  }
  area.lineTo(plot.bottomRight());
  painter.fillPath(area, faded(palette().color(QPalette::Text), 0.22));
}

void CurveEditor::paintGrid(QPainter& painter) const {
  const QRectF plot = plotRect();
  const ValueAxis axis = valueAxis();
  const OpacityAxis opacities = opacityAxis();
  const QColor text = palette().color(QPalette::WindowText), line = faded(text, 0.14);
  const QFontMetricsF metrics(painter.font());
  for (double value : roundTicks(axis.low, axis.high, std::max(2, int(plot.width() / 64)))) {
    const double x = axis.pixelOf(value);
    painter.setPen(line);
    painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
    painter.setPen(faded(text, 0.85));
    const QString number = QString::number(value, 'g', 6);
    const double half = metrics.horizontalAdvance(number) / 2;
    const double left = std::min(x - half, width() - 2 * half - 2);
    painter.drawText(QPointF(left, plot.bottom() + rampBottom + metrics.ascent() + 2), number);
  }
  double lastY = 1e9;
  for (double opacity : opacities.ticks()) {
    const double y = opacities.pixelOf(opacity);
    painter.setPen(line);
    painter.drawLine(QPointF(plot.left(), y), QPointF(plot.right(), y));
    if (lastY - y < metrics.height() * 0.8) continue;
    lastY = y;
    painter.setPen(faded(text, 0.85));
    painter.drawText(QRectF(0, y - 8, plot.left() - 5, 16), Qt::AlignRight | Qt::AlignVCenter,
                     opacityText(opacity, opacities));
  }
  painter.setPen(faded(text, 0.85));
  painter.drawText(QPointF(4, metrics.ascent() + 2), axisName());
  if (!unit_.isEmpty()) painter.drawText(QRectF(0, 2, width() - 6, metrics.height()), Qt::AlignRight, unit_);
}

void CurveEditor::paintTissues(QPainter& painter) const {
  if (unit_ != QStringLiteral("HU")) return;
  const QRectF plot = plotRect();
  const ValueAxis axis = valueAxis();
  const QFontMetricsF metrics(painter.font());
  painter.setPen(QPen(faded(palette().color(QPalette::WindowText), 0.2), 1, Qt::DotLine));
  for (const Tissue& tissue : tissuesHu) {
    const double x = axis.pixelOf(tissue.value);
    if (x >= plot.left() && x <= plot.right())
      painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
  }
  painter.setPen(faded(palette().color(QPalette::WindowText), 0.6));
  const auto width = [&](const QString& name) { return metrics.horizontalAdvance(name); };
  for (const TissueLabel& label : tissueLabels(axis, width))
    painter.drawText(QPointF(label.left, plot.top() + metrics.ascent() + 1), label.name);
}

void CurveEditor::paintCurve(QPainter& painter) const {
  const QRectF plot = plotRect();
  const ValueAxis axis = valueAxis();
  const OpacityAxis opacities = opacityAxis();
  // The curve is straight in opacity between points, thus bent on a logarithmic axis: it is sampled every 2
  // pixels.
  QPolygonF line;
  const auto add = [&](double x, double opacity) { line << QPointF(x, opacities.pixelOf(opacity)); };
  add(plot.left(), curveAt(curve_, axis.low).opacity);
  for (std::size_t n = 0; n < curve_.points.size(); ++n) {
    const double x = axis.pixelOf(curve_.points[n].value);
    for (double between = line.last().x() + 2; between < std::min(x, plot.right()); between += 2)
      add(between, curveAt(curve_, axis.valueAt(between)).opacity);
    if (x >= plot.left() && x <= plot.right()) add(x, curve_.points[n].opacity);
  }
  add(plot.right(), curveAt(curve_, axis.high).opacity);
  painter.save();
  painter.setClipRect(plot.adjusted(-1, -7, 1, 7));
  QPolygonF area = line;
  area << plot.bottomRight() << plot.bottomLeft();
  painter.setPen(Qt::NoPen);
  painter.setBrush(rampOf(curve_, axis, 0.35));
  painter.drawPolygon(area);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 1.6));
  painter.drawPolyline(line);
  painter.restore();
  for (int n = 0; n < int(curve_.points.size()); ++n) {
    const QPointF at = positionOf(n);
    if (at.x() < plot.left() - 1 || at.x() > plot.right() + 1) continue;
    painter.setBrush(toQColor(curve_.points[n].colour));
    painter.setPen(QPen(palette().color(n == selected_ ? QPalette::Highlight : QPalette::WindowText),
                        n == selected_ ? 2.5 : 1.2));
    painter.drawEllipse(at, n == selected_ ? 6 : 4.5, n == selected_ ? 6 : 4.5);
  }
}

void CurveEditor::paintRamp(QPainter& painter) const {
  const QRectF plot = plotRect();
  const ValueAxis axis = valueAxis();
  painter.fillRect(QRectF(plot.left(), plot.bottom() + 9, plot.width(), 10), rampOf(curve_, axis, 1));
  for (int n = 0; n < int(curve_.points.size()); ++n) {
    const QRectF swatch = swatchOf(n);
    if (window_ || swatch.center().x() < plot.left() - 1 || swatch.center().x() > plot.right() + 1) continue;
    painter.setBrush(toQColor(curve_.points[n].colour));
    painter.setPen(QPen(palette().color(n == selected_ ? QPalette::Highlight : QPalette::WindowText),
                        n == selected_ ? 2 : 1));
    painter.drawRoundedRect(swatch, 2, 2);
  }
}

// Paints the range in the colour that slices use.
void CurveEditor::paintRange(QPainter& painter) const {
  if (!range_) return;
  const QRectF plot = plotRect();
  const ValueAxis axis = valueAxis();
  const QColor colour = QColor::fromRgb(rangeTint);
  const double low = std::clamp(axis.pixelOf(range_->low), plot.left(), plot.right()),
               high = std::clamp(axis.pixelOf(range_->high), plot.left(), plot.right());
  painter.fillRect(QRectF(QPointF(low, plot.top()), QPointF(high, plot.bottom())), faded(colour, 0.18));
  for (int end : {0, 1}) {
    const double x = axis.pixelOf(endOfRange(end));
    if (x < plot.left() - 1 || x > plot.right() + 1) continue;
    const QRectF flag = rangeHandle(end);
    painter.setPen(QPen(colour, 1.4));
    painter.drawLine(QPointF(x, flag.top()), QPointF(x, plot.bottom()));
    painter.setPen(QPen(palette().color(QPalette::WindowText), 0.8));
    painter.setBrush(colour);
    const double outer = end == 0 ? flag.left() : flag.right();
    painter.drawPolygon(QPolygonF{QPointF(x, flag.top()), QPointF(outer, flag.top() + 3),
                                  QPointF(outer, flag.bottom() - 3), QPointF(x, flag.bottom())});
  }
}

}  // namespace volumen
