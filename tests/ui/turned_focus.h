#pragma once

#include <QString>
#include <functional>

#include "tests/ui/journey.h"

namespace volumen::tests {

/// Presses keys that move the focus or open something over the views. The view in focus must have the
/// keyboard focus. Each function returns a deviation from window.md ("Work by keyboard", "Arrange views"), or
/// an empty text. None makes an undo step.

/// Tab or Shift+Tab goes to the next view row by row. It leaves a maximised view, which then gets the
/// keyboard focus again.
QString wrongAfterTab(Journey& w, bool isBack);
/// F6 goes to another part of the window, and back to the view.
QString wrongAfterParts(Journey& w);
/// F10 maximises the view. F10 or Esc shows all views again. `wrongAlone` returns what is wrong meanwhile.
QString wrongWhileAlone(Journey& w, bool byEscape, const std::function<QString()>& wrongAlone);
/// Shift+F10 opens the view's menu, which is then closed.
QString wrongAfterMenu(Journey& w);
/// G opens a field. A number is typed and confirmed, which is an undo step, or cancelled. The view then has
/// the keyboard focus.
QString wrongAfterNumber(Journey& w, int number, bool isMeant);

/// Activates the window after a menu or dialog, as a window manager does, so that it receives keys again.
void takeKeysBack(Journey& w);

}  // namespace volumen::tests
