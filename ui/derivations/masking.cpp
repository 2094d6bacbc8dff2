#include "ui/derivations/masking.h"

#include <QAction>
#include <utility>

#include "results/text/text.h"
#include "viewer/scene/automatic.h"

namespace volumen {

Masking::Masking(Session& session, Jobs& jobs)
    : session_(session),
      table_(new QAction(tr("Remove table"), this)),
      reset_(new QAction(tr("Reset scissors"), this)),
      volumes_(maskedVolumesRule(
                   session, [this] { return nextKey(); }, [this] { return isMaking_; }),
               session, &jobs) {
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
  connect(&session_, &Session::workspaceChanged, this, [this] {
    if (isMaking_) return;
    showState();
    // From the event loop, because the workspace is reporting a change.
    if (!steps_.empty()) QMetaObject::invokeMethod(this, &Masking::next, Qt::QueuedConnection);
  });
  connect(&volumes_, &MaskedVolumes::changed, this, &Masking::next);
  next();
}

void Masking::cut(const SeriesKey& series, const Lasso& lasso) {
  ask({series, lasso.inside ? tr("Cut inside") : tr("Cut outside"),
       [added = std::make_shared<const Lasso>(lasso)](Mask& mask) { mask.lassos.push_back(added); }});
}

void Masking::showState() {
  const Workspace& workspace = session_.workspace();
  const LoadedSeriesPtr& series = session_.series();
  const bool offered = series && inHounsfield(*series->volume, series->histogram);
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

void Masking::ask(Step step) {
  steps_.push_back(std::move(step));
  next();
}

// Makes steps up to the first whose volume is missing, which is then made.
void Masking::next() {
  if (std::exchange(isMaking_, true)) return;
  while (!steps_.empty() && hasEnded(steps_.front())) steps_.pop_front();
  keepMade();
  isMaking_ = false;
  volumes_.update();
  showState();
}

std::optional<PoolKey> Masking::nextKey() const {
  if (steps_.empty()) return {};
  return PoolKey{steps_.front().series, maskAfter(steps_.front())};
}

Mask Masking::maskAfter(const Step& step) const {
  Mask mask = session_.maskOf(step.series);
  step.change(mask);
  return mask;
}

// Returns false while the volume of the step is being made.
bool Masking::hasEnded(const Step& step) {
  if (!session_.workspace().series.contains(step.series)) return true;
  const Mask mask = maskAfter(step);
  const bool isWholeThere = session_.seriesWith(step.series, {}) != nullptr;
  if (isWholeThere && !session_.seriesWith(step.series, mask)) {
    const auto* made = volumes_.find({step.series, mask});
    if (!made || made->isTriedAgain) return false;
    if (!made->value) {
      const MaskedVolumes::Entry refused = *made;
      volumes_.tryAgain([&](const PoolKey& key) { return key == refused.key; });  // a later step may need it
      if (!refused.isCancelled) Q_EMIT failed(QString::fromStdString(refused.whyNot));
      return true;
    }
    session_.keep(made->value, mask);
  }
  if (mask != session_.maskOf(step.series)) session_.setMask(step.text, step.series, mask);
  return true;
}

// A workspace does not keep a mask that cannot be made.
void Masking::keepMade() {
  const std::vector<MaskedVolumes::Entry> all = volumes_.entries();
  for (const MaskedVolumes::Entry& made : all) {
    const auto& [series, mask] = made.key;
    if (session_.maskOf(series) != mask || session_.seriesWith(series, mask)) continue;
    if (made.value) {
      session_.keep(made.value, mask);
    } else if (!made.isCancelled) {
      session_.setMask(tr("Show all"), series, {});
      Q_EMIT failed(QString::fromStdString(made.whyNot));
    }
  }
}

}  // namespace volumen
