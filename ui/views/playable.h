#pragma once

#include <QString>
#include <optional>

#include "io/study/cine.h"
#include "io/study/series_key.h"

namespace volumen {

/// A sequence to play: frames of a clip, slices of a stack, time points. Positions count from 0.
class Playable {
 public:
  virtual ~Playable() = default;

  /// Returns the name of one element: "Frame".
  virtual QString noun() const = 0;
  /// Returns a name of the sequence for a tool tip; empty if there is none.
  virtual QString axis() const { return {}; }
  /// Returns the number of positions; 0 if nothing is shown.
  virtual int count() const = 0;
  /// Returns the position shown or requested last.
  virtual int place() const = 0;
  /// Returns how many numbers there are. Slices have the numbers of the file: positions between them have
  /// none, and some numbers may have no position.
  virtual int numberCount() const { return count(); }
  /// Returns the number of a position, from 1; 0 if it has none.
  virtual int numberOf(int place) const { return place + 1; }
  /// Returns the number of what is shown; 0 if it has none.
  virtual int number() const { return numberOf(place()); }
  /// Returns the position of a number, if it has one.
  virtual std::optional<int> placeOf(int number) const { return number - 1; }
  /// Returns the source of the sequence. Playback settings hold until it changes.
  virtual SeriesKey source() const = 0;
  virtual Cine cine() const = 0;
  /// Returns whether it was acquired to be played.
  virtual bool isClip() const { return false; }
  /// Goes to a position for the user. Within a gesture this is one undo step.
  virtual void goTo(int place) = 0;
  /// Starts playback; `steps` is the index of the undo stack.
  virtual void begin(int /*steps*/) {}
  /// Goes to a position during playback.
  virtual void play(int place) { goTo(place); }
  /// Returns whether the previous position is on screen and this one can be shown.
  virtual bool isReady(int place) const = 0;
  /// Returns whether positions are skipped, rather than delayed, if they come faster than they are shown.
  virtual bool keepsTime() const { return false; }
  /// Ends playback at the current position.
  virtual void stop() {}
  /// Ends playback and goes to the position of the workspace.
  virtual void giveUp() {}
};

}  // namespace volumen
