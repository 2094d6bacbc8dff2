#pragma once

#include <limits>
#include <vector>

#include "io/study/cine.h"

namespace volumen {

/// Returns frames per second from the file, or 15 if the file gives no rate.
double cineRate(const Cine& cine);

/// The positions that are played, and in which order.
struct CineRound {
  int first = 0, last = 0;    ///< inclusive
  bool backAndForth = false;  ///< plays back from the last to the first
  bool loops = true;          ///< starts again at the end
  double rate = 0;            ///< positions per second; 0: cineRate()
  bool operator==(const CineRound&) const = default;
};

/// The current position in a round as time passes. Each position is shown as long as its file says.
class CineTrack {
 public:
  static constexpr int asManyAsAreDue = std::numeric_limits<int>::max();

  /// Starts at `place`, upwards or `backwards`. Starts at the first position if `place` is outside the round
  /// or at the end of one that does not loop.
  CineTrack(const Cine& cine, const CineRound& round, int place, bool backwards = false);

  int place() const { return steps_[at_].place; }
  /// Returns the next position; at the end of a round that does not loop, the last one.
  int next() const { return steps_[indexAfter(at_)].place; }
  bool isBackwards() const { return at_ >= places_; }
  /// Returns whether a round that does not loop is at its end.
  bool isOver() const { return !loops_ && at_ + 1 == steps_.size(); }
  /// Advances by `ms`, over at most `most` positions; any further one waits for the next call. Returns
  /// place().
  int pass(double ms, int most = asManyAsAreDue);

 private:
  struct Step {
    int place;
    double ms;
  };
  std::size_t indexAfter(std::size_t step) const;

  std::vector<Step> steps_;  // one round
  std::size_t places_;       // positions on the way up
  bool loops_;
  std::size_t at_ = 0;
  double spent_ = 0;  // ms since the current position was reached
};

}  // namespace volumen
