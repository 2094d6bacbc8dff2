#include "ui/widgets/on_screen.h"

#include <QGuiApplication>
#include <QScreen>
#include <QStyle>
#include <QWidget>

#include <algorithm>

namespace volumen {

QRect onScreen(QRect window, const QList<QRect>& screens) {
  if (screens.isEmpty()) return window;
  const auto shared = [&](const QRect& screen) {
    const QRect both = screen & window;
    return both.isEmpty() ? 0 : qint64(both.width()) * both.height();
  };
  const QRect screen = *std::ranges::max_element(screens, {}, shared);
  window.setSize(window.size().boundedTo(screen.size()));
  window.moveLeft(std::clamp(window.left(), screen.left(), screen.right() + 1 - window.width()));
  window.moveTop(std::clamp(window.top(), screen.top(), screen.bottom() + 1 - window.height()));
  return window;
}

void putOnScreen(QWidget& window) {
  if (window.isMaximized() || window.isFullScreen()) return;
  QList<QRect> screens;
  const int title = window.style()->pixelMetric(QStyle::PM_TitleBarHeight);
  for (const QScreen* each : QGuiApplication::screens())
    screens << each->availableGeometry().adjusted(0, title, 0, 0);
  window.setGeometry(onScreen(window.geometry(), screens));
}

}  // namespace volumen
