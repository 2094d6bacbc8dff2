#pragma once

#include <QIcon>

class QApplication;

namespace volumen {

enum class Theme { dark, light };

/// Colours and controls of the whole program.
void applyTheme(QApplication& app, Theme theme);

/// An icon of resources/icons in the text colour of the theme applied last.
QIcon icon(const QString& name);

}  // namespace volumen
