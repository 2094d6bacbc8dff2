#pragma once

#include <QString>
#include <functional>

#include "tests/ui/journey.h"

namespace volumen::tests {

/// Keys that move the focus or open something over the views, pressed where the view in focus has the keys.
/// Each returns what is not as window.md has it ("Work by keyboard", "Arrange views"), empty: all is; none is
/// a step of undo.

/// Tab, or Shift+Tab, to the next view row by row; out of a view that is alone, which then has the keys
/// again.
QString wrongAfterTab(Journey& w, bool isBack);
/// F6 to another part of the window, and back to the view.
QString wrongAfterParts(Journey& w);
/// F10 shows the view alone, and again, or Esc, all of them. `wrongAlone`: what is wrong in it meanwhile.
QString wrongWhileAlone(Journey& w, bool byEscape, const std::function<QString()>& wrongAlone);
/// Shift+F10 opens its menu, which is closed.
QString wrongAfterMenu(Journey& w);
/// G opens a field; a number is typed and meant, which is a step, or given up. The view has the keys then.
QString wrongAfterNumber(Journey& w, int number, bool isMeant);

/// After a menu or a dialog was closed: as a window manager does, so that keys go to the window again.
void takeKeysBack(Journey& w);

}  // namespace volumen::tests
