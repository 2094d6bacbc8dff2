#pragma once

#include <QList>
#include <QRect>

namespace volumen {

/// A window's rectangle moved, and where there is no room for it made smaller, so that all of it lies on one of
/// these screens: the one that most of it lies on, else the first.
QRect onScreen(QRect window, const QList<QRect>& screens);

}  // namespace volumen
