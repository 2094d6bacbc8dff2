#pragma once

#include <QString>

namespace volumen {

/// Returns words by which other programs call a command, so that a search for these finds it too. Empty if
/// there are none. `name` is the object name of an action or a panel ("accuracyDock").
QString otherWordsFor(const QString& name);

}  // namespace volumen
