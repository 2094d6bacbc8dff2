#pragma once

#include "tests/ui/journey.h"

namespace volumen::tests {

/// Undoes or redoes until the undo stack is at this step, or as near as it goes.
inline void goToStep(Journey& w, int step) {
  const QUndoStack& stack = w.window.session().undoStack();
  while (stack.index() > step && stack.canUndo()) w.child<QAction>("undo")->trigger();
  while (stack.index() < step && stack.canRedo()) w.child<QAction>("redo")->trigger();
}

/// Undoes back to the last known step and applies `take`. Returns false at the first step.
template <class Known, class Take>
bool undoneTo(Journey& w, int first, const Known& known, const Take& take) {
  const QUndoStack& stack = w.window.session().undoStack();
  if (stack.index() <= first) return false;
  do w.child<QAction>("undo")->trigger();
  while (!known.contains(stack.index()));
  take(stack.index());
  return true;
}

/// Redoes to the next known step and applies `take`. Returns false if nothing is undone.
template <class Known, class Take>
bool doneAgain(Journey& w, const Known& known, const Take& take) {
  const QUndoStack& stack = w.window.session().undoStack();
  if (stack.index() >= stack.count()) return false;
  do w.child<QAction>("redo")->trigger();
  while (!known.contains(stack.index()) && stack.canRedo());
  if (!known.contains(stack.index())) qFatal("a step that no act made: %s", qPrintable(stack.undoText()));
  take(stack.index());
  return true;
}

}  // namespace volumen::tests
