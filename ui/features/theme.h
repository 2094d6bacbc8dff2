#pragma once

#include <QIcon>

#include "ui/workspace/preferences.h"

class QApplication;

namespace volumen {

/// Colours, controls and text size (in percent of the system's) of the whole program.
void applyTheme(QApplication& app, Theme theme, int textPercent);

/// An icon of resources/icons in the text colour of the theme applied last.
QIcon icon(const QString& name);

}  // namespace volumen
