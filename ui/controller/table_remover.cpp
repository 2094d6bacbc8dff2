#include "ui/controller/table_remover.h"

#include "viewer/scene/automatic.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

Result<ShownSeriesPtr> seriesWithout(const ShownSeriesPtr& series, const CancelToken& cancel) {
  Result<VolumePtr> volume = withoutTable(*series->volume, cancel);
  if (!volume) return volume.error();
  auto without = std::make_shared<ShownSeries>(*series);
  without->volume = *volume;
  without->warnings.emplace_back("The table was removed: what lies outside the patient is shown as air.");
  return ShownSeriesPtr(without);
}

}  // namespace

TableRemover::TableRemover(Session& session, QObject* parent)
    : QAction(tr("Remove table"), parent), session_(session) {
  setObjectName(QStringLiteral("removeTable"));
  setCheckable(true);
  pool_.setMaxThreadCount(1);
  connect(this, &QAction::triggered, this, &TableRemover::take);
  connect(&session_, &Session::withoutTableNeeded, this, &TableRemover::makeAgain);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series == after.series) return;
    if (!areOneSeries(before.series, after.series)) cancel();
    showState();
  });
  showState();
}

TableRemover::~TableRemover() {
  cancel_.cancel();
  pool_.waitForDone();
}

void TableRemover::cancel() {
  cancel_.cancel();
  cancel_ = CancelToken();
  showState();
}

void TableRemover::showState() {
  const ShownSeriesPtr& series = session_.series();
  const bool offered = series && inHounsfield(*series->volume, series->histogram);
  setEnabled(offered);
  setChecked(session_.tableRemoved());
  setToolTip(!series    ? tr("Open a CT series first.")
             : !offered ? tr("Only for CT: the values of this series are not Hounsfield units.")
                        : tr("Hide what is not connected with the patient: table, cushions, cables."));
}

void TableRemover::take(bool removed) {
  const ShownSeriesPtr series = session_.series();
  cancel_.cancel();
  cancel_ = CancelToken();
  if (!removed) {
    session_.removeTable(tr("Show table"), nullptr);
  } else if (const ShownSeriesPtr made = session_.withoutTable()) {
    show(made);
  } else {
    make(series, [this](const ShownSeriesPtr& without) { show(without); });
  }
}

// For a workspace that was read: no step of its own.
void TableRemover::makeAgain(const ShownSeriesPtr& series) {
  const SeriesKey key = keyOf(series->series);
  if (makingAgain_ == key) return;
  if (!inHounsfield(*series->volume, series->histogram))
    return session_.change(tr("Show table"), [&](Workspace& w) { w.series.at(key).tableRemoved = false; });
  makingAgain_ = key;
  make(series, [this](const ShownSeriesPtr& without) { session_.takeWithoutTable(without); });
}

void TableRemover::make(const ShownSeriesPtr& series, const std::function<void(const ShownSeriesPtr&)>& use) {
  Q_EMIT begun();
  pool_.start([this, series, use, cancel = cancel_] {
    const Result<ShownSeriesPtr> made = seriesWithout(series, cancel);
    QMetaObject::invokeMethod(
        this,
        [this, cancel, use, made] {
          Q_EMIT ended();
          makingAgain_.reset();
          if (cancel.cancelled()) return;
          if (made) return use(*made);
          showState();
          Q_EMIT failed(QString::fromStdString(made.message()));
        },
        Qt::QueuedConnection);
  });
}

void TableRemover::show(const ShownSeriesPtr& without) { session_.removeTable(tr("Remove table"), without); }

}  // namespace volumen
