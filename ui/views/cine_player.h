#pragma once

#include <QObject>
#include <QTimer>
#include <deque>
#include <functional>

#include "ui/views/playable.h"
#include "ui/workspace/cine.h"

namespace volumen {

/// Plays by the clock and measures how fast positions come on screen. It waits until a position is on screen
/// before it requests the next. Clips that keep time are the exception: there only the latest counts.
class CinePlayer : public QObject {
  Q_OBJECT
 public:
  /// `clock` returns ms from any origin; null is the clock of the machine.
  CinePlayer(Playable& what, const CineRound& round, std::function<double()> clock = {});

  /// Continues from the current position with other settings.
  void setRound(const CineRound& round);
  bool isBackwards() const { return track_.isBackwards(); }
  /// Returns whether the player is changing the position right now.
  bool isGoing() const { return isGoing_; }
  /// Returns whether the position is still the one requested last, so nothing else changed it.
  bool isWhereItWent() const { return what_.stack().place.index == asked_; }
  /// Stops the timer and deletes the player later, because this may be called from its tick.
  void end();
  /// Reads the clock and moves on, as the timer does.
  void tick();
  /// Reports that a position is now on screen.
  void tellShown(int place);
  /// Returns the distinct positions per second over the last second; 0 until one second has passed.
  double rate() const;
  /// Returns whether the rate is 5 % off the wanted one.
  bool isLate() const;

 Q_SIGNALS:
  /// The player reached its end, or something else changed the position.
  void over();

 private:
  double wantedRate() const;
  void show();

  Playable& what_;
  CineRound round_;
  const std::function<double()> clock_;
  CineTrack track_;
  bool isGoing_ = false;
  int asked_;    // the position requested last
  double seen_;  // time of the last reading of the clock
  QTimer timer_;
  int shown_ = -1;
  std::deque<double> shownAt_;  // ms, newest last
};

}  // namespace volumen
