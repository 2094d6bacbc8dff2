#include "ui/controller/time_points_ahead.h"

#include <algorithm>

#include "ui/controller/loader.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// Requests the next time point first; clips wrap around to the first one.
std::vector<SeriesKey> neighboursOf(const Workspace& workspace, const SeriesKey& series) {
  const std::vector<const Series*> steps = timePointsOf(workspace, series);
  const auto at = std::ranges::find(steps, series, [](const Series* s) { return keyOf(*s); });
  if (steps.size() < 2 || at == steps.end()) return {};
  std::vector<SeriesKey> keys{keyOf(at + 1 == steps.end() ? *steps.front() : **(at + 1))};
  if (at != steps.begin() && keyOf(**(at - 1)) != keys.front()) keys.push_back(keyOf(**(at - 1)));
  return keys;
}

}  // namespace

TimePointsAhead::TimePointsAhead(Session& session, Loader& loader, QObject* parent)
    : QObject(parent), session_(session), loader_(loader) {
  // Runs later, because a change may request another series.
  connect(&session_, &Session::workspaceChanged, this,
          [this] { QMetaObject::invokeMethod(this, &TimePointsAhead::look, Qt::QueuedConnection); });
  connect(&loader_, &Loader::loadedAhead, &session_,
          [this](const LoadedSeriesPtr& series) { session_.keep(series); });
  connect(&loader_, &Loader::idle, this, &TimePointsAhead::look);
}

void TimePointsAhead::look() {
  const Workspace& workspace = session_.workspace();
  const ViewState& view = workspace.view(workspace.focus);
  const LoadedSeriesPtr shown = session_.seriesOf(workspace.focus);
  if (loader_.isBusy() || !shown || showsFrames(view.kind)) return;
  if (seen_.lock() != shown) {
    seen_ = shown;
    wanted_ = neighboursOf(workspace, view.series);
    // The time points of a series have one grid and size.
    while (!wanted_.empty() && !session_.pool().hasRoomFor(wanted_.size() * shown->volume->bytes()))
      wanted_.pop_back();
  }
  loadNext();
}

void TimePointsAhead::loadNext() {
  while (!wanted_.empty() && !loader_.isBusy()) {
    const SeriesKey key = wanted_.front();
    wanted_.erase(wanted_.begin());
    const auto known = session_.workspace().series.find(key);
    if (known == session_.workspace().series.end() || known->second.missing || session_.seriesNamed(key))
      continue;
    loader_.loadAhead(*known->second.series);
  }
}

}  // namespace volumen
