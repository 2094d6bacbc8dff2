#include "ui/overlays/readable_text.h"

#include <QRegularExpression>
#include <QStaticText>
#include <QTextOption>
#include <cmath>
#include <numbers>
#include <span>

namespace volumen {

namespace {

// Rings of copies around the letters. The closest one, painted last, is the outline. It gives a contrast of
// 4.5:1 on any background; the others fade out.
struct Ring {
  double radius;  // pixels
  int copies, alpha;
};
constexpr Ring halo[] = {{3.5, 12, 20}, {2.3, 12, 60}, {1.1, 12, 230}};

// Returns the relative luminance of WCAG 2.1.
double luminance(const QColor& colour) {
  const auto linear = [](double part) {
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

// Returns black, or white for dark letters.
QColor haloColour(const QColor& letters) {
  constexpr double middle = 0.18;  // equal contrast with both
  return luminance(letters) < middle ? Qt::white : Qt::black;
}

// Calls `draw` with the offset of each copy, and last for the letters themselves; the painter has their
// colour.
template <class Draw>
void drawWithHalo(QPainter& painter, const QColor& colour, std::span<const Ring> rings, const Draw& draw) {
  QColor about = haloColour(colour);
  for (const Ring& ring : rings) {
    about.setAlpha(ring.alpha);
    painter.setPen(about);
    for (int n = 0; n < ring.copies; ++n) {
      const double angle = 2 * std::numbers::pi * n / ring.copies;
      draw(ring.radius * QPointF(std::cos(angle), std::sin(angle)));
    }
  }
  painter.setPen(colour);
  draw(QPointF());
}

}  // namespace

void paintReadable(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour) {
  QStaticText line(text);
  line.setTextFormat(Qt::PlainText);
  QTextOption option;
  option.setTextDirection(Qt::LeftToRight);
  option.setWrapMode(QTextOption::NoWrap);
  line.setTextOption(option);
  line.prepare(painter.transform(), painter.font());
  drawWithHalo(painter, colour, halo, [&](QPointF by) { painter.drawStaticText(topLeft + by, line); });
}

void paintReadable(QPainter& painter, const QRectF& place, int flags, const QString& text,
                   const QColor& colour) {
  drawWithHalo(painter, colour, std::span(halo).last(1),
               [&](QPointF by) { painter.drawText(place.translated(by), flags, text); });
}

QString leadingDate(const QString& text) {
  static const QRegularExpression date(QStringLiteral("^\\d{4}-\\d\\d-\\d\\d\\b"));
  return date.match(text).captured();
}

}  // namespace volumen
