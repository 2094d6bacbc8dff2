#pragma once

#include <QWidget>

#include "ui/workspace/measurement_chart.h"

namespace volumen {

/// A chart of values under a measurement or of segments, in the colours of the window. Knows no session.
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

/// The span of both axes over all points and their SD, with room where there is none: of counts and other
/// values that are none of them below 0 from 0 on.
QRectF spanOf(const MeasuredChart& chart);

}  // namespace volumen
