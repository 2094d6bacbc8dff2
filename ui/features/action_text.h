#pragma once

#include <QString>

class QAction;

namespace volumen {

/// Returns the text of an action without menu markup, such as "Reset view".
QString textOf(const QAction& action);
/// Returns the shortcuts of an action as written on the keyboard, such as "Ctrl+Z, F2". Includes a key that a
/// view handles itself, which follows a tab in the text. Empty if it has none.
QString keysOf(const QAction& action);
/// Returns the tool tip of an action with its keys as plain text, such as "Reset view (F)".
QString tipOf(const QAction& action);

}  // namespace volumen
