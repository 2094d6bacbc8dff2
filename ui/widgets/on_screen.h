#pragma once

#include <QList>
#include <QRect>

class QWidget;

namespace volumen {

/// Moves a window's rectangle, and shrinks it if necessary, to fit one of these screens: the one with the
/// largest part of it, else the first.
QRect onScreen(QRect window, const QList<QRect>& screens);

/// Moves a window with a saved position, perhaps from another screen, so that its title is visible, too.
/// Maximised and full-screen windows stay.
void putOnScreen(QWidget& window);

}  // namespace volumen
