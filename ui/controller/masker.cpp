#include "ui/controller/masker.h"

#include <QAction>
#include <algorithm>
#include <span>

#include "ui/widgets/plain_text.h"
#include "viewer/scene/automatic.h"
#include "viewer/segment/mask.h"

namespace volumen {

namespace {

// A volume that lacks a part of what a mask takes away: the table, and so many of its outlines.
struct CutVolume {
  VolumePtr volume;
  std::size_t outlines = 0;
};

// The one in memory that lacks most of it; none: only the whole one is.
std::optional<CutVolume> beforeLast(const Session& session, const SeriesKey& series, Mask mask) {
  while (!mask.lassos.empty()) {
    mask.lassos.pop_back();
    if (mask.empty()) break;
    if (const ShownSeriesPtr held = session.seriesWith(series, mask))
      return CutVolume{held->volume, mask.lassos.size()};
  }
  return {};
}

Result<ShownSeriesPtr> maskedSeries(const ShownSeries& whole, const std::optional<CutVolume>& before,
                                    const Mask& mask, const CancelToken& cancel) {
  Result<VolumePtr> volume =
      before ? cutFurther(*before->volume, std::span(mask.lassos).subspan(before->outlines), cancel)
             : masked(*whole.volume, mask, cancel);
  if (!volume) return volume.error();
  auto without = std::make_shared<ShownSeries>(whole);
  without->volume = *volume;
  if (mask.tableRemoved)
    without->warnings.emplace_back("The table was removed: what lies outside the patient is shown as air.");
  if (!mask.lassos.empty())
    without->warnings.emplace_back("Parts were cut away with the scissors: they are shown as air.");
  return ShownSeriesPtr(without);
}

bool canLoseTable(const ShownSeriesPtr& series) {
  return series && inHounsfield(*series->volume, series->histogram);
}

}  // namespace

Masker::Masker(Session& session, QObject* parent)
    : QObject(parent),
      session_(session),
      table_(new QAction(tr("Remove table"), this)),
      reset_(new QAction(tr("Reset scissors"), this)) {
  table_->setObjectName(QStringLiteral("removeTable"));
  table_->setCheckable(true);
  reset_->setObjectName(QStringLiteral("resetScissors"));
  reset_->setToolTip(tr("Bring back all that was cut away."));
  pool_.setMaxThreadCount(1);
  connect(table_, &QAction::triggered, this, [this](bool removed) {
    ask({keyOf(session_.series()->series), removed ? table_->text() : tr("Show table"),
         [removed](Mask& mask) { mask.tableRemoved = removed; }});
  });
  connect(reset_, &QAction::triggered, this, [this] {
    const Workspace& w = session_.workspace();
    ask({w.view(w.focus).series, reset_->text(), [](Mask& mask) { mask.lassos.clear(); }});
  });
  connect(&session_, &Session::maskedNeeded, this, [this](const SeriesKey& series) {
    const auto isWaiting = [&](const Job& job) { return job.series == series && !job.change; };
    if (std::ranges::none_of(jobs_, isWaiting)) ask({series, {}, {}});
  });
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace&, const Workspace& after) {
    if (isRunning_ && !after.series.contains(jobs_.front().series)) cancel_.cancel();
    showState();
  });
  showState();
}

Masker::~Masker() {
  cancel_.cancel();
  pool_.waitForDone();
}

void Masker::cut(const SeriesKey& series, const Lasso& lasso) {
  ask({series, lasso.inside ? tr("Cut inside") : tr("Cut outside"),
       [added = std::make_shared<const Lasso>(lasso)](Mask& mask) { mask.lassos.push_back(added); }});
}

void Masker::cancel() {
  cancel_.cancel();
  jobs_.erase(jobs_.begin() + (isRunning_ ? 1 : 0), jobs_.end());
  showState();
}

void Masker::showState() {
  const Workspace& workspace = session_.workspace();
  const ShownSeriesPtr& series = session_.series();
  const bool offered = canLoseTable(series);
  table_->setEnabled(offered);
  table_->setChecked(series && session_.maskOf(keyOf(series->series)).tableRemoved);
  const QString tip = !series ? tr("Open a CT series first.")
                      : !offered
                          ? tr("Only for CT: the values of this series are not Hounsfield units.")
                          : tr("Hide what is not connected with the patient: table, cushions, cables.");
  table_->setToolTip(toolTipOf(tip));
  reset_->setEnabled(!session_.maskOf(workspace.view(workspace.focus).series).lassos.empty());
}

void Masker::ask(Job job) {
  jobs_.push_back(std::move(job));
  next();
}

// Makes the first step for which a volume has to be made first, and all before it that need none.
void Masker::next() {
  while (!isRunning_ && !jobs_.empty()) {
    const Job& job = jobs_.front();
    const Mask before = session_.maskOf(job.series);
    Mask mask = before;
    if (job.change) job.change(mask);
    const ShownSeriesPtr whole = session_.seriesWith(job.series, {});
    if (whole && mask.tableRemoved && !canLoseTable(whole)) {
      giveUp(job, tr("Only for CT: the values of this series are not Hounsfield units."));
    } else if (whole && !session_.seriesWith(job.series, mask)) {
      return begin(mask, whole);
    } else if (mask != before) {
      session_.setMask(job.text, job.series, mask);
    }
    jobs_.pop_front();
  }
  showState();
}

void Masker::begin(const Mask& mask, const ShownSeriesPtr& whole) {
  isRunning_ = true;
  cancel_ = CancelToken();
  const Mask before = session_.maskOf(jobs_.front().series);
  Q_EMIT begun(mask.lassos.empty() ? tr("Removing table") : tr("Cutting"));
  const std::optional<CutVolume> last = beforeLast(session_, jobs_.front().series, mask);
  pool_.start([this, before, last, mask, whole, cancel = cancel_] {
    const Result<ShownSeriesPtr> made = maskedSeries(*whole, last, mask, cancel);
    QMetaObject::invokeMethod(
        this, [this, before, mask, made] { take(before, mask, made); }, Qt::QueuedConnection);
  });
}

// The step is made where the mask is still the one that it was to change; else it is made anew.
void Masker::take(const Mask& before, const Mask& mask, const Result<ShownSeriesPtr>& made) {
  isRunning_ = false;
  Q_EMIT ended();
  const Job job = jobs_.front();
  const bool isKnown = session_.workspace().series.contains(job.series);
  if (cancel_.cancelled() || !isKnown) {
    jobs_.pop_front();
  } else if (!made) {
    jobs_.pop_front();
    giveUp(job, QString::fromStdString(made.message()));
  } else {
    session_.takeMasked(mask, *made);
    if (session_.maskOf(job.series) == before) {
      jobs_.pop_front();
      if (job.change) session_.setMask(job.text, job.series, mask);
    }
  }
  next();
}

// A workspace does not keep a mask that cannot be made.
void Masker::giveUp(const Job& job, const QString& sentence) {
  if (!job.change) session_.setMask(tr("Show all"), job.series, {});
  Q_EMIT failed(sentence);
}

}  // namespace volumen
