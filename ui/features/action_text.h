#pragma once

#include <QString>

class QAction;

namespace volumen {

/// The text of an action, without the marks of menus: "Reset view".
QString textOf(const QAction& action);
/// Its keys as they are written on the keyboard, "Ctrl+Z, F2"; empty: it has none. Also of one whose key a
/// view hears itself, which stands in its text behind a tabulator.
QString keysOf(const QAction& action);
/// What its tool tip says, which names its keys: "Reset view (F)"; plain text.
QString tipOf(const QAction& action);

}  // namespace volumen
