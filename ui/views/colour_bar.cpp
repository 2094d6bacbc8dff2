#include "ui/views/colour_bar.h"

#include <cmath>

#include "ui/overlays/readable_text.h"
#include "ui/workspace/value_text.h"

namespace volumen {

void paintColourBar(QPainter& painter, const QRectF& area, ColourMap map, const Window& window,
                    const QString& unit) {
  constexpr double wide = 8, fromEdge = 8, beside = 5;  // logical pixels
  const double high = std::min(140.0, area.height() / 3);
  if (high < 50) return;  // a small view has no room for it
  const QRectF bar(area.left() + fromEdge, area.center().y() + 12, wide, high);
  const ColourTable& colours = colourTable(map);
  for (int row = 0; row < int(high); ++row)
    painter.fillRect(QRectF(bar.x(), bar.y() + row, wide, 1),
                     QColor::fromRgb(colours[std::size_t(255.0 * (1 - row / (high - 1)))]));
  const QFontMetricsF metrics(painter.font());
  const auto end = [&](double value, double baseline) {
    paintReadable(painter, {bar.right() + beside, baseline - metrics.ascent()},
                  windowNumbers({value, window.width}).second + unit, Qt::white);
  };
  const double half = std::abs(window.width) / 2;
  end(window.centre + (window.width < 0 ? -half : half), bar.top() + metrics.ascent() - 2);
  end(window.centre - (window.width < 0 ? -half : half), bar.bottom());
}

}  // namespace volumen
