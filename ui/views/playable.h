#pragma once

#include "io/study/cine.h"
#include "io/study/series_key.h"
#include "ui/workspace/stack.h"

namespace volumen {

/// A sequence to play: frames of a clip, slices of a stack, time points.
class Playable {
 public:
  virtual ~Playable() = default;

  /// Returns its positions, with the one shown or requested last.
  virtual Stack stack() const = 0;
  /// Returns a name of the sequence for a tool tip; empty if there is none.
  virtual QString axis() const { return {}; }
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
