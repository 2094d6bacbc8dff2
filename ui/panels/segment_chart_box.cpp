#include "ui/panels/segment_chart_box.h"

#include <QClipboard>
#include <QGuiApplication>
#include <algorithm>

#include "results/numbers/segment_charts.h"
#include "results/numbers/segments_over_time.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/derivations/measurement_charts.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

constexpr std::size_t mostUnchosen = 6;  // most segments drawn without a selection, as more lines are hard to
                                         // distinguish

}  // namespace

SegmentChartBox::SegmentChartBox(const Session& session, Jobs& jobs, QWidget* parent)
    : QWidget(parent),
      session_(session),
      kind_(choiceField({QStringLiteral("segmentChartKind"), tr("What is drawn")})),
      said_(wrappedLabel(QStringLiteral("segmentChartSaid"))),
      copy_(buttonOf(QStringLiteral("segmentChartCopy"), tr("Copy as CSV"),
                     [this] { QGuiApplication::clipboard()->setText(chartAsCsv(view_->chart())); })),
      view_(new ChartView),
      overTime_(overTimeRule(), session, &jobs) {
  kind_->addItem(chartText(ChartKind::histogram), int(ChartKind::histogram));
  copy_->setToolTip(tr("Copy the numbers of the chart"));
  view_->setObjectName(QStringLiteral("segmentChart"));
  stack(this, {lineOf({kind_, {said_, 1}, copy_}), {view_, 1}});
  connect(kind_, &QComboBox::activated, this, [this] {
    overTime_.tryAgain([](const OverTimeKey&) { return true; });
    showChosen();
  });
  connect(&overTime_, &OverTime::changed, this, &SegmentChartBox::showChosen);
  setMeasured({}, {}, {});
}

void SegmentChartBox::setMeasured(const std::vector<SegmentMap>& maps,
                                  const std::vector<SegmentReport>& reports,
                                  const std::vector<std::size_t>& chosen) {
  maps_ = maps, reports_ = reports, chosen_ = chosen;
  if (chosen_.empty() && reports_.size() <= mostUnchosen)
    for (std::size_t n = 0; n < reports_.size(); ++n) chosen_.push_back(n);
  if (wanted_ && *wanted_ != keyNow()) wanted_.reset();
  overTime_.update();
  offerKinds();
  showChosen();
}

// Offers values over time if the series has several time points.
void SegmentChartBox::offerKinds() {
  const bool isOverTime =
      session_.series() && hasTimePoints(session_.workspace(), keyOf(session_.series()->series));
  if (!isOverTime)
    kind_->removeItem(1);
  else if (kind_->count() < 2)
    kind_->addItem(chartText(ChartKind::overTime), int(ChartKind::overTime));
  kind_->setEnabled(isOverTime);
}

void SegmentChartBox::showChosen() {
  const auto kind = ChartKind(kind_->currentData().toInt());
  if (chosen_.empty()) return draw({}, tr("Choose rows: their values are drawn here."));
  if (kind == ChartKind::histogram) {
    std::vector<SegmentReport> shown;
    for (const std::size_t n : chosen_) shown.push_back(reports_[n]);
    return draw(segmentHistograms(shown, scale()), {});
  }
  wanted_ = keyNow();
  overTime_.update();
  if (const SegmentsOverTime* values = overTime())
    return draw(segmentsOverTimeChart(*values, reports_, chosen_), {});
  const auto* failed = overTime_.find(*wanted_);
  draw({}, failed ? QString::fromStdString(failed->whyNot) : tr("Reading all time points..."));
}

const SegmentsOverTime* SegmentChartBox::overTime() const {
  const auto* made = wanted_ ? overTime_.find(*wanted_) : nullptr;
  return made ? made->value.get() : nullptr;
}

SegmentChartBox::OverTimeKey SegmentChartBox::keyNow() const {
  OverTimeKey wanted{{}, {}, scale()};
  for (const SegmentMap& map : maps_)
    for (const Segment& segment : map.segments) wanted.segments.emplace_back(map.labels, segment.number);
  if (session_.series())
    for (const Series* step : timePointsOf(session_.workspace(), keyOf(session_.series()->series)))
      wanted.steps.push_back(keyOf(*step));
  return wanted;
}

// Whole volumes count, as for the other numbers of segments.
TimeSteps SegmentChartBox::wholeSteps() const {
  TimeSteps steps = timeStepsOf(session_, keyOf(session_.series()->series));
  for (TimeStep& step : steps.all) {
    const LoadedSeriesPtr whole = session_.seriesWith(keyOf(step.series), {});
    step.volume = whole ? whole->volume : nullptr;
  }
  return steps;
}

SegmentChartBox::OverTime::Rule SegmentChartBox::overTimeRule() {
  return {.wanted = [this] { return wanted_ ? std::vector{*wanted_} : std::vector<OverTimeKey>(); },
          .work = [this](const OverTimeKey& key, std::size_t) -> OverTime::Work {
            return [steps = wholeSteps(), maps = maps_, unit = key.scale.unit](const Job& job) {
              return std::make_shared<const SegmentsOverTime>(
                  segmentsIn(steps, maps, unit, job.progress(), job.cancel()));
            };
          },
          .name =
              [this](const OverTimeKey&) {
                return JobName(tr("Reading all time points"), seriesText(session_.series()->series));
              },
          .bytes = [](const SegmentsOverTime&) { return std::size_t(0); },
          .areVersions = [](const OverTimeKey&, const OverTimeKey&) { return true; },
          .lacksMemory = outOfMemory,
          .wasCancelled = tr("Reading was cancelled. Choose the chart again to read them.").toStdString()};
}

void SegmentChartBox::draw(const MeasuredChart& chart, const QString& sentence) {
  view_->setChart(chart);
  copy_->setEnabled(!chart.lines.empty());
  said_->setText(sentence.isEmpty() ? chart.problem : sentence);
}

ValueScale SegmentChartBox::scale() const {
  return session_.series() ? shownScale(session_.series()->series) : ValueScale{};
}

}  // namespace volumen
