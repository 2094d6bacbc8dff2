#pragma once

#include <QString>

namespace volumen {

/// Returns words under which other programs know a command, by which it is found, too; empty where there are
/// none. `name` is the object name of an action, or of a panel ("accuracyDock").
QString otherWordsFor(const QString& name);

}  // namespace volumen
