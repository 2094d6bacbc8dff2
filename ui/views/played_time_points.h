#pragma once

#include <functional>
#include <vector>

#include "ui/views/playable.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The time points of a view's series, or its echoes, diffusion weights or directions. Each is shown, however
/// long it takes to load; time points are loaded ahead.
class PlayedTimePoints : public Playable {
 public:
  /// `isDrawn` returns whether the view shows the current state of the workspace.
  PlayedTimePoints(Session& session, ViewId view, std::function<bool()> isDrawn);

  /// Updates the list of time points.
  void look();

  Stack stack() const override;
  QString axis() const override { return axis_; }
  SeriesKey source() const override { return steps_.empty() ? SeriesKey{} : steps_.front(); }
  Cine cine() const override;
  bool isClip() const override { return steps_.size() > 1; }
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
  int stepsBefore_ = 0;  // index of the undo stack when playback began
};

}  // namespace volumen
