#pragma once

#include <limits>
#include <vector>

#include "io/study/cine.h"

namespace volumen {

/// Frames a second as the file says; 15 where it does not.
double cineRate(const Cine& cine);

/// Which places are played, and how.
struct CineRound {
  int first = 0, last = 0;    ///< both are shown
  bool backAndForth = false;  ///< from the last one back to the first
  bool loops = true;          ///< begins again
  double rate = 0;            ///< places a second; 0: cineRate()
  bool operator==(const CineRound&) const = default;
};

/// Where one is in a round, by the time that is let pass: each place is shown as long as its file says.
class CineTrack {
 public:
  static constexpr int asManyAsAreDue = std::numeric_limits<int>::max();

  /// From `place` on, upwards or `backwards`; from the first one where `place` is outside, or the end of a
  /// round that does not loop.
  CineTrack(const Cine& cine, const CineRound& round, int place, bool backwards = false);

  int place() const { return steps_[at_].place; }
  /// What comes next; of a round that is over its last one.
  int next() const { return steps_[indexAfter(at_)].place; }
  bool isBackwards() const { return at_ >= places_; }
  /// A round that does not loop is at its end.
  bool isOver() const { return !loops_ && at_ + 1 == steps_.size(); }
  /// Goes on by so many ms, over at most so many places: what is due further on waits. Returns place().
  int pass(double ms, int most = asManyAsAreDue);

 private:
  struct Step {
    int place;
    double ms;
  };
  std::size_t indexAfter(std::size_t step) const;

  std::vector<Step> steps_;  // one round
  std::size_t places_;       // upwards
  bool loops_;
  std::size_t at_ = 0;
  double spent_ = 0;  // ms of the step
};

}  // namespace volumen
