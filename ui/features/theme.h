#pragma once

#include <QIcon>

#include "ui/workspace/preferences.h"

class QApplication;

namespace volumen {

/// Sets colours, controls and text size (`textPercent` of the system's size) of the whole program.
void applyTheme(QApplication& app, Theme theme, int textPercent);

/// Returns an icon of resources/icons in the text colour of the last applied theme.
QIcon icon(const QString& name);

}  // namespace volumen
