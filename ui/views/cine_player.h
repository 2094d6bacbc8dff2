#pragma once

#include <QObject>
#include <QTimer>
#include <deque>
#include <functional>

#include "ui/views/playable.h"
#include "ui/workspace/cine.h"

namespace volumen {

/// Plays by the clock, and knows how fast places really come. It never asks for a place before the one before
/// is on screen, but of what keeps time, where the latest alone counts.
class CinePlayer : public QObject {
  Q_OBJECT
 public:
  /// `clock`: ms since anything; null: those of the machine.
  CinePlayer(Playable& what, const CineRound& round, std::function<double()> clock = {});

  /// Goes on from where it is, in another way.
  void setRound(const CineRound& round);
  bool isBackwards() const { return track_.isBackwards(); }
  /// Whether it is going to a place right now.
  bool isGoing() const { return isGoing_; }
  /// Whether what is shown is where it went last: nothing else went to another place.
  bool isWhereItWent() const { return what_.place() == asked_; }
  /// Looks no more, and is deleted later: it may be looking.
  void end();
  /// Looks at the clock, as its timer does.
  void tick();
  /// A place came on screen.
  void tellShown(int place);
  /// Different places a second, over the last one; 0 until that is over.
  double rate() const;
  /// Whether that is 5 % off what is wanted.
  bool isLate() const;

 Q_SIGNALS:
  /// It is at its end, or something else went to another place.
  void over();

 private:
  double wantedRate() const;
  void show();

  Playable& what_;
  CineRound round_;
  const std::function<double()> clock_;
  CineTrack track_;
  bool isGoing_ = false;
  int asked_;    // the place it went to last
  double seen_;  // what the clock said last
  QTimer timer_;
  int shown_ = -1;
  std::deque<double> shownAt_;  // ms, the newest last
};

}  // namespace volumen
