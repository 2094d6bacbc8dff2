#include "ui/panels/chart_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"

namespace volumen {

namespace {

constexpr int restMs = 300;  // delay after the last change of a drag

}  // namespace

ChartPanel::ChartPanel(Session& session, ChartJobs& jobs, QWidget* parent)
    : QWidget(parent),
      session_(session),
      jobs_(&jobs),
      said_(plainLabel({})),
      kind_(new QComboBox),
      copy_(new QToolButton),
      view_(new ChartView) {
  makeLayout();
  atRest_.setSingleShot(true);
  atRest_.setInterval(restMs);
  connect(&atRest_, &QTimer::timeout, this, [this] {
    if (QGuiApplication::mouseButtons() != Qt::NoButton) return atRest_.start();
    showSelected();
  });
  connect(&session_, &Session::workspaceChanged, this, &ChartPanel::showSelected);
  connect(&session_, &Session::preferencesChanged, this, &ChartPanel::showSelected);
  connect(&jobs, &ChartJobs::ready, this, &ChartPanel::take);
  connect(kind_, &QComboBox::activated, this, [this] {
    if (const auto kind = ChartKind(kind_->currentData().toInt()); kind != ChartKind::profile)
      preferred_ = kind;
    showSelected();
  });
  connect(copy_, &QToolButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(chartAsCsv(view_->chart())); });
  showSelected();
}

void ChartPanel::makeLayout() {
  said_->setObjectName(QStringLiteral("chartSaid"));
  said_->setWordWrap(true);
  kind_->setObjectName(QStringLiteral("chartKind"));
  kind_->setAccessibleName(tr("What is drawn"));
  copy_->setObjectName(QStringLiteral("chartCopy"));
  copy_->setText(tr("Copy as CSV"));
  copy_->setToolTip(tr("Copy the numbers of the chart"));
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  row->addWidget(kind_);
  row->addStretch();
  row->addWidget(copy_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  column->addLayout(row);
  column->addWidget(said_);
  column->addWidget(view_, 1);
}

void ChartPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  showSelected();
}

void ChartPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  if (jobs_) jobs_->drop();
}

void ChartPanel::setWatched(bool watched) {
  isWatched_ = watched;
  if (watched) return showSelected();
  overTime_.reset();
  if (jobs_) jobs_->drop();
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
    jobs_->drop();
    atRest_.start();
  }
  return atRest_.isActive();
}

// Computes nothing while hidden.
void ChartPanel::showSelected() {
  if (!jobs_) return;
  const Measurement* m = findMeasurement(session_.workspace(), session_.workspace().selected);
  const std::vector<ChartKind> kinds = m ? chartsOf(session_.workspace(), *m) : std::vector<ChartKind>();
  offer(kinds);
  if (kinds.empty()) {
    jobs_->drop();
    view_->setChart({});
    copy_->setEnabled(false);
    return say(tr("Select a length, a polyline or a region: the values under it are drawn here."));
  }
  const auto kind = ChartKind(kind_->currentData().toInt());
  if (!isWatched_ || !isVisible() || isToRest(*m, kind)) return;
  if (!jobs_->request(*m, kind)) {
    view_->setChart({});
    copy_->setEnabled(false);
    say(tr("Show the series of %1 to see its values.").arg(nameText(*m)));
  }
}

void ChartPanel::offer(const std::vector<ChartKind>& kinds) {
  const QSignalBlocker quiet(kind_);
  kind_->clear();
  for (const ChartKind kind : kinds) kind_->addItem(chartText(kind), int(kind));
  kind_->setEnabled(kinds.size() > 1);
  if (const int at = kind_->findData(int(preferred_)); at >= 0) kind_->setCurrentIndex(at);
}

void ChartPanel::take(int measurement, const MeasuredChart& chart) {
  const Measurement* m = findMeasurement(session_.workspace(), measurement);
  if (!m || measurement != session_.workspace().selected) return;
  view_->setChart(chart);
  copy_->setEnabled(!chart.lines.empty());
  QString sentence = nameText(*m);
  if (!chart.problem.isEmpty()) sentence += QStringLiteral(": ") + chart.problem;
  say(sentence);
}

void ChartPanel::say(const QString& sentence) { said_->setText(sentence); }

}  // namespace volumen
