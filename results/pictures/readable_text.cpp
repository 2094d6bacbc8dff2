#include "results/pictures/readable_text.h"

#include <QCache>
#include <QPaintEngine>
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

constexpr int lineMargin = 8;  // pixels about a line, for its halo and for glyphs that reach over

// A line takes 37 drawings, so lines are kept as pictures, of a full screen and its neighbours in a stack.
constexpr int keptLines = 400;

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

void paintLine(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour) {
  QStaticText line(text);
  line.setTextFormat(Qt::PlainText);
  QTextOption option;
  option.setTextDirection(Qt::LeftToRight);
  option.setWrapMode(QTextOption::NoWrap);
  line.setTextOption(option);
  line.prepare(painter.transform(), painter.font());
  drawWithHalo(painter, colour, halo, [&](QPointF by) { painter.drawStaticText(topLeft + by, line); });
}

int dotsPerMeterOf(const QPainter& painter) {
  return int(std::lround(painter.device()->logicalDpiY() / 0.0254));
}

// Returns a line in the font of `like` on a transparent ground, `within` the pixel (`lineMargin`,
// `lineMargin`).
QImage pictureOfLine(const QPainter& like, QPointF within, const QString& text, const QColor& colour) {
  const QSize size = QFontMetricsF(like.font(), like.device()).size(Qt::TextSingleLine, text).toSize();
  QImage picture(size + QSize(2 * lineMargin + 2, 2 * lineMargin + 2), QImage::Format_ARGB32_Premultiplied);
  picture.setDotsPerMeterX(dotsPerMeterOf(like));
  picture.setDotsPerMeterY(dotsPerMeterOf(like));
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setFont(like.font());
  paintLine(painter, QPointF(lineMargin, lineMargin) + within, text, colour);
  return picture;
}

}  // namespace

void paintReadable(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour) {
  const QTransform& toDevice = painter.deviceTransform();
  const bool isOnPixels =
      painter.paintEngine()->type() == QPaintEngine::Raster && toDevice.type() <= QTransform::TxTranslate;
  if (!isOnPixels) return paintLine(painter, topLeft, text, colour);
  const QPointF at = toDevice.map(topLeft);
  const QPointF pixel(std::floor(at.x()), std::floor(at.y()));
  const QPointF within = at - pixel;
  // Each position between pixels gives other grey values.
  const QString key = QStringLiteral("%1 %2 %3 %4 %5 %6")
                          .arg(within.x())
                          .arg(within.y())
                          .arg(colour.rgba())
                          .arg(dotsPerMeterOf(painter))
                          .arg(painter.font().key(), text);
  thread_local QCache<QString, QImage> kept(keptLines);
  if (!kept.contains(key)) kept.insert(key, new QImage(pictureOfLine(painter, within, text, colour)));
  painter.drawImage(toDevice.inverted().map(pixel - QPointF(lineMargin, lineMargin)), *kept[key]);
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
