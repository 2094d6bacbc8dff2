#include "ui/controller/mask_jobs.h"

#include <QAction>
#include <algorithm>
#include <span>

#include "viewer/scene/automatic.h"
#include "viewer/segment/mask.h"

namespace volumen {

namespace {

// A volume that lacks part of a mask: the table and the first `outlines` outlines.
struct CutVolume {
  VolumePtr volume;
  std::size_t outlines = 0;
};

// Returns the volume in memory that lacks most of the mask; nothing if only the whole volume is in memory.
std::optional<CutVolume> beforeLast(const Session& session, const SeriesKey& series, Mask mask) {
  while (!mask.lassos.empty()) {
    mask.lassos.pop_back();
    if (mask.empty()) break;
    if (const LoadedSeriesPtr held = session.seriesWith(series, mask))
      return CutVolume{held->volume, mask.lassos.size()};
  }
  return {};
}

Result<LoadedSeriesPtr> maskedSeries(const LoadedSeries& whole, const std::optional<CutVolume>& before,
                                     const Mask& mask, const CancelToken& cancel) {
  Result<VolumePtr> volume =
      before ? cutFurther(*before->volume, std::span(mask.lassos).subspan(before->outlines), cancel)
             : masked(*whole.volume, mask, cancel);
  if (!volume) return volume.error();
  auto without = std::make_shared<LoadedSeries>(whole);
  without->volume = *volume;
  if (mask.tableRemoved)
    without->warnings.emplace_back("The table was removed: what lies outside the patient is shown as air.");
  if (!mask.lassos.empty())
    without->warnings.emplace_back("Parts were cut away with the scissors: they are shown as air.");
  return LoadedSeriesPtr(without);
}

bool canLoseTable(const LoadedSeriesPtr& series) {
  return series && inHounsfield(*series->volume, series->histogram);
}

}  // namespace

MaskJobs::MaskJobs(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent),
      session_(session),
      table_(new QAction(tr("Remove table"), this)),
      reset_(new QAction(tr("Reset scissors"), this)),
      lane_(&jobs) {
  table_->setObjectName(QStringLiteral("removeTable"));
  table_->setCheckable(true);
  reset_->setObjectName(QStringLiteral("resetScissors"));
  reset_->setToolTip(tr("Bring back all that was cut away."));
  connect(table_, &QAction::triggered, this, [this](bool removed) {
    ask({keyOf(session_.series()->series), removed ? table_->text() : tr("Show table"),
         [removed](Mask& mask) { mask.tableRemoved = removed; }});
  });
  connect(reset_, &QAction::triggered, this, [this] {
    const Workspace& w = session_.workspace();
    ask({w.view(w.focus).series, reset_->text(), [](Mask& mask) { mask.lassos.clear(); }});
  });
  connect(&session_, &Session::maskedNeeded, this, [this](const SeriesKey& series) {
    const auto isWaiting = [&](const Step& step) { return step.series == series && !step.change; };
    if (std::ranges::none_of(steps_, isWaiting)) ask({series, {}, {}});
  });
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace&, const Workspace& after) {
    if (lane_.isBusy() && !after.series.contains(steps_.front().series)) drop();
    showState();
  });
  showState();
}

void MaskJobs::cut(const SeriesKey& series, const Lasso& lasso) {
  ask({series, lasso.inside ? tr("Cut inside") : tr("Cut outside"),
       [added = std::make_shared<const Lasso>(lasso)](Mask& mask) { mask.lassos.push_back(added); }});
}

void MaskJobs::showState() {
  const Workspace& workspace = session_.workspace();
  const LoadedSeriesPtr& series = session_.series();
  const bool offered = canLoseTable(series);
  table_->setEnabled(offered);
  table_->setChecked(series && session_.maskOf(keyOf(series->series)).tableRemoved);
  if (!series)
    table_->setToolTip(tr("Open a CT series first."));
  else if (!offered)
    table_->setToolTip(tr("Only for CT: the values of this series are not Hounsfield units."));
  else
    table_->setToolTip(tr("Hide what is not connected with the patient: table, cushions, cables."));
  reset_->setEnabled(!session_.maskOf(workspace.view(workspace.focus).series).lassos.empty());
}

void MaskJobs::ask(Step step) {
  steps_.push_back(std::move(step));
  next();
}

// Makes steps that need no new volume, up to the first that needs one, and starts that one.
void MaskJobs::next() {
  while (!lane_.isBusy() && !isTaking_ && !steps_.empty()) {
    const Step& step = steps_.front();
    if (!session_.workspace().series.contains(step.series)) {
      steps_.pop_front();
      continue;
    }
    const Mask before = session_.maskOf(step.series);
    Mask mask = before;
    if (step.change) step.change(mask);
    const LoadedSeriesPtr whole = session_.seriesWith(step.series, {});
    if (whole && mask.tableRemoved && !canLoseTable(whole)) {
      giveUp(step, tr("Only for CT: the values of this series are not Hounsfield units."));
    } else if (whole && !session_.seriesWith(step.series, mask)) {
      return begin(mask, whole);
    } else if (mask != before) {
      session_.setMask(step.text, step.series, mask);
    }
    steps_.pop_front();
  }
  showState();
}

void MaskJobs::begin(const Mask& mask, const LoadedSeriesPtr& whole) {
  const SeriesKey series = steps_.front().series;
  lane_.run(
      mask.lassos.empty() ? tr("Removing table") : tr("Cutting"),
      [whole, mask, last = beforeLast(session_, series, mask)](const Job& job) {
        return maskedSeries(*whole, last, mask, job.cancel());
      },
      [this, mask, before = session_.maskOf(series)](const Result<LoadedSeriesPtr>& made) {
        take(before, mask, made);
      },
      [this] { drop(); });
}

// Makes the step if the mask is still the one it started from; otherwise repeats the work.
void MaskJobs::take(const Mask& before, const Mask& mask, const Result<LoadedSeriesPtr>& made) {
  isTaking_ = true;
  const Step step = steps_.front();
  const bool isKnown = session_.workspace().series.contains(step.series);
  if (!isKnown || !made) {
    steps_.pop_front();
    if (isKnown) giveUp(step, QString::fromStdString(made.message()));
  } else {
    session_.takeMasked(mask, *made);
    if (session_.maskOf(step.series) == before) {
      steps_.pop_front();
      if (step.change) session_.setMask(step.text, step.series, mask);
    }
  }
  isTaking_ = false;
  next();
}

// Drops the step in progress. The next one starts from the event loop, because the workspace may be reporting
// a change.
void MaskJobs::drop() {
  lane_.giveUpAll();
  steps_.pop_front();
  QMetaObject::invokeMethod(
      this, [this] { next(); }, Qt::QueuedConnection);
}

// A workspace does not keep a mask that cannot be made.
void MaskJobs::giveUp(const Step& step, const QString& sentence) {
  if (!step.change) session_.setMask(tr("Show all"), step.series, {});
  Q_EMIT failed(sentence);
}

}  // namespace volumen
