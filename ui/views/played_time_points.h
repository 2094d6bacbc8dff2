#pragma once

#include <functional>
#include <vector>

#include "ui/views/playable.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The steps in time, echo, diffusion weight or direction of what a view shows. Each is shown, however long
/// it takes to be loaded: that is done ahead.
class PlayedTimePoints : public Playable {
 public:
  /// `isDrawn`: whether the view shows what the workspace says.
  PlayedTimePoints(Session& session, ViewId view, std::function<bool()> isDrawn);

  /// Looks again which steps there are.
  void look();

  QString noun() const override;
  QString axis() const override { return axis_; }
  int count() const override { return int(steps_.size()); }
  int place() const override;
  SeriesKey source() const override { return steps_.empty() ? SeriesKey{} : steps_.front(); }
  Cine cine() const override;
  bool isClip() const override { return count() > 1; }
  void begin(int steps) override { stepsBefore_ = steps; }
  void goTo(int place) override;
  void play(int place) override;
  bool isReady(int place) const override;

 private:
  Session& session_;
  const ViewId view_;
  const std::function<bool()> isDrawn_;
  std::vector<SeriesKey> steps_;
  QString axis_;
  int stepsBefore_ = 0;  // to undo, as it began to be played
};

}  // namespace volumen
