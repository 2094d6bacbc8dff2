#pragma once

#include <QString>
#include <optional>

#include "io/study/cine.h"
#include "ui/data/series_key.h"

namespace volumen {

/// Places that are shown one after the other: frames of a clip, slices of a stack, steps in time. Places
/// count from 0.
class Playable {
 public:
  virtual ~Playable() = default;

  /// What one of them is called: "Frame".
  virtual QString noun() const = 0;
  /// Of all of them, for a tool tip; empty: nothing.
  virtual QString axis() const { return {}; }
  /// 0: nothing is shown.
  virtual int count() const = 0;
  /// Which one is shown, or was asked for last.
  virtual int place() const = 0;
  /// How many numbers there are. Of slices they are those of the file: places between them have none, and
  /// some may have no place.
  virtual int numberCount() const { return count(); }
  /// The number of a place, from 1; 0: it has none.
  virtual int numberOf(int place) const { return place + 1; }
  /// That of what is shown, likewise.
  virtual int number() const { return numberOf(place()); }
  /// The place of a number; none: it has no place.
  virtual std::optional<int> placeOf(int number) const { return number - 1; }
  /// What it is made of: how it is played holds until that is another one.
  virtual SeriesKey source() const = 0;
  virtual Cine cine() const = 0;
  /// Whether it was taken to be played.
  virtual bool isClip() const { return false; }
  /// Goes there by hand; in a gesture that is one step to undo.
  virtual void goTo(int place) = 0;
  /// It begins to be played, after so many steps to undo.
  virtual void begin(int /*steps*/) {}
  /// Goes there as it is played.
  virtual void play(int place) { goTo(place); }
  /// Whether the place before is on screen, and this one can be.
  virtual bool isReady(int place) const = 0;
  /// Where places come faster than they are shown: whether some are left out, and not time.
  virtual bool keepsTime() const { return false; }
  /// It is played no longer: stays where it is.
  virtual void stop() {}
  /// It is played no longer: goes where the workspace says.
  virtual void giveUp() {}
};

}  // namespace volumen
