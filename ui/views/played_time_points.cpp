#include "ui/views/played_time_points.h"

#include <algorithm>

#include "results/series/time_points.h"
#include "results/text/text.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {
// Time points per second: the default if the file recommends none, and the limit.
constexpr double usualRate = 10, mostRate = 100;
}  // namespace

PlayedTimePoints::PlayedTimePoints(Session& session, ViewId view, std::function<bool()> isDrawn)
    : session_(session), view_(view), isDrawn_(std::move(isDrawn)) {
  look();
}

void PlayedTimePoints::look() {
  const Workspace& workspace = session_.workspace();
  const std::vector<const Series*> steps = timePointsOf(workspace, workspace.view(view_).series);
  steps_.clear();
  for (const Series* step : steps) steps_.push_back(keyOf(*step));
  axis_ = steps.size() > 1 ? timeAxisText(steps) : QString();
}

Stack PlayedTimePoints::stack() const {
  const auto at = std::ranges::find(steps_, session_.workspace().view(view_).series);
  return countedStack(tr("Time point"),
                      {at == steps_.end() ? 0 : int(at - steps_.begin()), int(steps_.size())});
}

Cine PlayedTimePoints::cine() const {
  const Series* series = seriesIn(session_.workspace(), view_);
  const double rate = series ? series->cine.framesPerSecond : 0;
  return {rate > 0 ? std::min(rate, mostRate) : usualRate, {}, false};
}

void PlayedTimePoints::goTo(int place) {
  if (place < 0 || place >= int(steps_.size())) return;
  const QString text = tr("Time point");
  session_.change(text, withTimePoint(session_.workspace(), view_, steps_[std::size_t(place)]), text);
}

void PlayedTimePoints::play(int place) {
  session_.playOn(stepsBefore_, [this, place] { goTo(place); });
}

bool PlayedTimePoints::isReady(int place) const {
  const bool needsNoVolume = showsFrames(session_.workspace().view(view_).kind);
  const bool isHere = place < int(steps_.size()) && session_.seriesNamed(steps_[std::size_t(place)]);
  return isDrawn_() && (needsNoVolume || (isHere && session_.seriesOf(view_)));
}

}  // namespace volumen
