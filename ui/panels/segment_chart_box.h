#pragma once

#include <QLabel>
#include <QToolButton>
#include <vector>

#include "ui/panels/chart_view.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// How often which values occur in the segments that are chosen in the table of numbers.
class SegmentChartBox : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentChartBox(QWidget* parent = nullptr);

  /// Values are drawn in the unit of the scale; of none it says what to do.
  void setChosen(const std::vector<SegmentReport>& segments, const ValueScale& scale);

 private:
  QLabel* said_;
  QToolButton* copy_;
  ChartView* view_;
};

}  // namespace volumen
