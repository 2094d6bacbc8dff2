#include "ui/panels/segment_chart_box.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/segment_charts.h"

namespace volumen {

SegmentChartBox::SegmentChartBox(QWidget* parent)
    : QWidget(parent), said_(plainLabel()), copy_(new QToolButton), view_(new ChartView) {
  said_->setObjectName(QStringLiteral("segmentChartSaid"));
  said_->setWordWrap(true);
  copy_->setObjectName(QStringLiteral("segmentChartCopy"));
  copy_->setText(tr("Copy as CSV"));
  copy_->setToolTip(tr("Copy the numbers of the chart"));
  view_->setObjectName(QStringLiteral("segmentChart"));
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  row->addWidget(said_, 1);
  row->addWidget(copy_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addLayout(row);
  column->addWidget(view_, 1);
  connect(copy_, &QToolButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(chartAsCsv(view_->chart())); });
  setChosen({}, {});
}

void SegmentChartBox::setChosen(const std::vector<SegmentReport>& segments, const ValueScale& scale) {
  const MeasuredChart chart = segmentHistograms(segments, scale);
  view_->setChart(chart);
  copy_->setEnabled(!chart.lines.empty());
  said_->setText(segments.empty()          ? tr("Choose rows: the histograms of their values are drawn here.")
                 : chart.problem.isEmpty() ? tr("Histogram of values")
                                           : chart.problem);
}

}  // namespace volumen
