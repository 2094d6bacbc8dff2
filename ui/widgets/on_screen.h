#pragma once

#include <QList>
#include <QRect>

class QWidget;

namespace volumen {

/// A window's rectangle moved, and where there is no room for it made smaller, so that all of it lies on one
/// of these screens: the one that most of it lies on, else the first.
QRect onScreen(QRect window, const QList<QRect>& screens);

/// The same for a window whose place was kept, on another screen perhaps: its title is seen, too. One that is
/// maximised or takes the full screen stays.
void putOnScreen(QWidget& window);

}  // namespace volumen
