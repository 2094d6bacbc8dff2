#pragma once

#include <QWidget>

#include "results/numbers/measurement_chart.h"

namespace volumen {

/// A chart of values under a measurement or of segments, in the window's colours. Independent of sessions.
class ChartView : public QWidget {
  Q_OBJECT
 public:
  explicit ChartView(QWidget* parent = nullptr);

  void setChart(const MeasuredChart& chart);
  const MeasuredChart& chart() const { return chart_; }
  QSize sizeHint() const override { return {300, 220}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  MeasuredChart chart_;
};

/// Returns the range of both axes over all points and their SD. An empty range is widened. The y axis begins
/// at 0 if no value is negative.
QRectF spanOf(const MeasuredChart& chart);

}  // namespace volumen
