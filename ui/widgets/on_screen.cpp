#include "ui/widgets/on_screen.h"

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

}  // namespace volumen
