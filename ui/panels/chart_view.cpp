#include "ui/panels/chart_view.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "results/plots/chart.h"
#include "results/text/text.h"

namespace volumen {

namespace {

constexpr int fontPx = 11;

QColor paler(QColor colour, double alpha) {
  colour.setAlphaF(float(alpha));
  return colour;
}

// Widens an empty range, as an axis needs two ends.
void widen(double& low, double& high) {
  if (high > low) return;
  const double room = low == 0 ? 1 : std::abs(low) / 10;
  low -= room, high += room;
}

// Adds bars from one SD below each mean to one above it.
void addBars(Chart& chart, const MeasuredChart& measured) {
  for (std::size_t n = 0; n < measured.sds.size(); ++n)
    for (std::size_t k = 0; k < measured.sds[n].size(); ++k) {
      const QPointF p = measured.lines[n][k];
      const double sd = measured.sds[n][k];
      ChartSeries bar{{}, paler(chart.series[n].colour, 0.5), true, false, {}, true};
      for (const double y : {p.y() - sd, p.y() + sd}) bar.points.push_back({p.x(), y, {}, false});
      chart.series.push_back(std::move(bar));
    }
}

// Elides names, so that the legend leaves room for the chart.
Chart drawnOf(const MeasuredChart& measured, const QPalette& palette, const QFontMetrics& metrics,
              int nameWidth) {
  Chart chart;
  chart.xTitle = measured.xTitle, chart.yTitle = measured.yTitle;
  chart.logarithmic = false;
  const QColor ink = palette.color(QPalette::WindowText);
  chart.colours = {ink, paler(ink, 0.7), paler(ink, 0.16), paler(ink, 0.08), palette.color(QPalette::Base)};
  for (std::size_t n = 0; n < measured.lines.size(); ++n) {
    const std::vector<QPointF>& line = measured.lines[n];
    ChartSeries& series = chart.series.emplace_back();
    series.colour = palette.color(QPalette::Highlight);
    if (!measured.looks.empty()) {
      series.name = metrics.elidedText(measured.looks[n].name, Qt::ElideRight, nameWidth);
      series.colour = measured.looks[n].colour;
    }
    series.line = true;
    series.bare = !measured.marked && line.size() > 1;
    for (const QPointF p : line) series.points.push_back({p.x(), p.y(), {}, false});
  }
  addBars(chart, measured);
  return chart;
}

}  // namespace

QRectF spanOf(const MeasuredChart& chart) {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (std::size_t n = 0; n < chart.lines.size(); ++n)
    for (std::size_t k = 0; k < chart.lines[n].size(); ++k) {
      const QPointF p = chart.lines[n][k];
      const double sd = chart.sds.empty() ? 0 : chart.sds[n][k];
      left = std::min(left, p.x()), right = std::max(right, p.x());
      low = std::min(low, p.y() - sd), high = std::max(high, p.y() + sd);
    }
  if (left > right) return {0, 0, 1, 1};
  if (low >= 0) low = 0;
  widen(left, right);
  widen(low, high);
  const double room = 0.06 * (high - low);
  return {QPointF(left, low == 0 ? 0 : low - room), QPointF(right, high + room)};
}

ChartView::ChartView(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("chartView"));
  setAccessibleName(tr("Chart of values"));
  setMinimumSize(200, 140);
}

void ChartView::setChart(const MeasuredChart& chart) {
  if (chart == chart_) return;
  chart_ = chart;
  const QRectF span = spanOf(chart_);
  setAccessibleDescription(chart_.lines.empty() ? chart_.problem
                                                : tr("%1 from %2 to %3 over %4")
                                                      .arg(chart_.yTitle)
                                                      .arg(span.top())
                                                      .arg(span.bottom())
                                                      .arg(chart_.xTitle));
  update();
}

void ChartView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  if (chart_.lines.empty()) return;
  drawChart(painter, rect(), drawnOf(chart_, palette(), fontMetrics(), width() / 3), spanOf(chart_), fontPx);
}

}  // namespace volumen
