#pragma once

#include <QAbstractButton>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMainWindow>
#include <QTabBar>
#include <QToolButton>

#include "ui/views/volume_view.h"

namespace volumen::tests {

inline QString nameOf(const QWidget* widget) {
  return QStringLiteral("%1 \"%2\" in %3")
      .arg(QLatin1String(widget->metaObject()->className()), widget->objectName(),
           widget->parentWidget()->objectName());
}

// Tabs behind the one in front lie outside the window.
inline bool isBehind(const QWidget* widget) {
  return qobject_cast<const QDockWidget*>(widget) && widget->geometry().right() < 0;
}

// Banners lie over the views, so that these do not move.
inline bool liesOver(const QWidget* widget) { return widget->objectName() == QStringLiteral("banner"); }

// Returns widgets that overlap a neighbour or cut off their text; empty if there are none.
inline QStringList flaws(const QMainWindow& window) {
  QStringList found;
  for (QWidget* widget : window.findChildren<QWidget*>()) {
    if (!widget->isVisible() || widget->isWindow()) continue;
    // Overlays of the picture have their own test, and tab arrows are Qt's.
    if (qobject_cast<VolumeView*>(widget->parentWidget()) || qobject_cast<QTabBar*>(widget->parentWidget()))
      continue;
    for (QWidget* other : widget->parentWidget()->findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
      if (other > widget && other->isVisible() && !other->isWindow() &&
          other->geometry().intersects(widget->geometry()) && !isBehind(widget) && !isBehind(other) &&
          !liesOver(widget) && !liesOver(other))
        found << nameOf(widget) + QStringLiteral(" overlaps ") + nameOf(other);
    const auto* label = qobject_cast<QLabel*>(widget);
    const bool reads =
        (label && !label->wordWrap() && label->sizePolicy().horizontalPolicy() != QSizePolicy::Ignored) ||
        qobject_cast<QAbstractButton*>(widget) || qobject_cast<QComboBox*>(widget);
    const auto* small = qobject_cast<QToolButton*>(widget);  // with a fixed size and a single letter
    if (!reads || (small && small->text().size() < 2)) continue;
    if (widget->width() < widget->minimumSizeHint().width())
      found << nameOf(widget) + QStringLiteral(" is too narrow");
    const QRect seen = widget->visibleRegion().boundingRect();
    if (!seen.isEmpty() && seen.width() < widget->width())
      found << nameOf(widget) + QStringLiteral(" is cut off");
  }
  return found;
}

}  // namespace volumen::tests
