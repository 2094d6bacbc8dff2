#include "ui/overlays/readable_text.h"

#include <QStaticText>
#include <QTextOption>
#include <cmath>
#include <numbers>

namespace volumen {

namespace {

// Rings of dark copies about the letters, the closest last: it is their edge, the others fade.
struct Ring {
  double radius;  // pixels
  int copies, alpha;
};
constexpr Ring halo[] = {{4, 12, 18}, {2.5, 12, 44}, {1, 8, 120}};

}  // namespace

void paintReadable(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour) {
  QStaticText line(text);
  line.setTextFormat(Qt::PlainText);
  QTextOption option;
  option.setTextDirection(Qt::LeftToRight);
  option.setWrapMode(QTextOption::NoWrap);
  line.setTextOption(option);
  line.prepare(painter.transform(), painter.font());
  for (const Ring& ring : halo) {
    painter.setPen(QColor(0, 0, 0, ring.alpha));
    for (int n = 0; n < ring.copies; ++n) {
      const double angle = 2 * std::numbers::pi * n / ring.copies;
      painter.drawStaticText(topLeft + ring.radius * QPointF(std::cos(angle), std::sin(angle)), line);
    }
  }
  painter.setPen(colour);
  painter.drawStaticText(topLeft, line);
}

}  // namespace volumen
