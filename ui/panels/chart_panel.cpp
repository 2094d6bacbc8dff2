#include "ui/panels/chart_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QSignalBlocker>
#include <algorithm>

#include "ui/widgets/fields.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"

namespace volumen {

namespace {

constexpr int restMs = 300;  // delay after the last change of a drag

}  // namespace

ChartPanel::ChartPanel(Session& session, FrameService& frames, Jobs& jobs, QWidget* parent)
    : QWidget(parent),
      session_(session),
      frames_(frames),
      said_(wrappedLabel(QStringLiteral("chartSaid"))),
      kind_(choiceField({QStringLiteral("chartKind"), tr("What is drawn")})),
      copy_(buttonOf(QStringLiteral("chartCopy"), tr("Copy as CSV"),
                     [this] { QGuiApplication::clipboard()->setText(chartAsCsv(view_->chart())); })),
      view_(new ChartView),
      charts_(measurementChartsRule(session, [this] { return wanted_; }), session, &jobs) {
  copy_->setToolTip(tr("Copy the numbers of the chart"));
  stack(this, {lineOf({kind_, {}, copy_}), said_, {view_, 1}}, 8);
  atRest_.setSingleShot(true);
  atRest_.setInterval(restMs);
  connect(&atRest_, &QTimer::timeout, this, [this] {
    if (QGuiApplication::mouseButtons() != Qt::NoButton) return atRest_.start();
    showSelected();
  });
  connect(&session_, &Session::workspaceChanged, this, &ChartPanel::showSelected);
  connect(&session_, &Session::preferencesChanged, this, &ChartPanel::showSelected);
  connect(&charts_, &MeasurementCharts::changed, this, &ChartPanel::showChart);
  connect(kind_, &QComboBox::activated, this, [this] {
    if (const auto kind = ChartKind(kind_->currentData().toInt()); kind != ChartKind::profile)
      preferred_ = kind;
    showSelected();
  });
  showSelected();
}

void ChartPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  showSelected();
}

void ChartPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  drop();
}

void ChartPanel::setWatched(bool watched) {
  isWatched_ = watched;
  if (watched) return showSelected();
  overTime_.reset();
  drop();
}

// Returns whether to wait, so that a drag does not read all time points at each of its changes.
bool ChartPanel::isToRest(const Measurement& measurement, ChartKind kind) {
  if (kind != ChartKind::overTime) {
    overTime_.reset();
    atRest_.stop();
    return false;
  }
  if (overTime_ != measurement) {
    overTime_ = measurement;
    drop();
    atRest_.start();
  }
  return atRest_.isActive();
}

void ChartPanel::drop() {
  wanted_.reset();
  charts_.update();
}

// Computes nothing while hidden.
void ChartPanel::showSelected() {
  const Measurement* m = findMeasurement(session_.workspace(), session_.workspace().selected);
  const std::vector<ChartKind> kinds = m ? chartsOf(session_.workspace(), *m) : std::vector<ChartKind>();
  offer(kinds);
  if (kinds.empty()) {
    drop();
    return draw({}, tr("Select a length, a polyline or a region: the values under it are drawn here."));
  }
  const auto kind = ChartKind(kind_->currentData().toInt());
  if (!isWatched_ || !isVisible() || isToRest(*m, kind)) return;
  wanted_ = chartKeyOf(session_, frames_, *m, kind);
  charts_.update();
  if (!wanted_) return draw({}, tr("Show the series of %1 to see its values.").arg(nameText(*m)));
  showChart();
}

void ChartPanel::offer(const std::vector<ChartKind>& kinds) {
  const QSignalBlocker quiet(kind_);
  kind_->clear();
  for (const ChartKind kind : kinds) kind_->addItem(chartText(kind), int(kind));
  kind_->setEnabled(kinds.size() > 1);
  if (const int at = kind_->findData(int(preferred_)); at >= 0) kind_->setCurrentIndex(at);
}

// The chart before stays until the next one is ready.
void ChartPanel::showChart() {
  const Measurement* m = findMeasurement(session_.workspace(), session_.workspace().selected);
  const auto* made = wanted_ ? charts_.find(*wanted_) : nullptr;
  if (!m || !made) return;
  const MeasuredChart chart = made->value ? *made->value : MeasuredChart();
  const QString problem = made->value ? chart.problem : QString::fromStdString(made->whyNot);
  draw(chart, problem.isEmpty() ? nameText(*m) : nameText(*m) + QStringLiteral(": ") + problem);
}

void ChartPanel::draw(const MeasuredChart& chart, const QString& sentence) {
  view_->setChart(chart);
  copy_->setEnabled(!chart.lines.empty());
  said_->setText(sentence);
}

}  // namespace volumen
