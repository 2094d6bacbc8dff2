#include "ui/views/overlays.h"

#include <cmath>

namespace volumen {

namespace {

constexpr double margin = 10;  // pixels

const QColor textColour(0xd7, 0xdc, 0xe2), warningColour(0xff, 0xc8, 0x5a);

// Text that can be read on white as on black: a dark rim around it.
void paintText(QPainter& painter, const QRectF& where, int align, const QString& text, const QColor& colour) {
  painter.setPen(QColor(0, 0, 0, 200));
  for (const QPointF& by : {QPointF(-1, 0), QPointF(1, 0), QPointF(0, -1), QPointF(0, 1), QPointF(1, 1)})
    painter.drawText(where.translated(by), align, text);
  painter.setPen(colour);
  painter.drawText(where, align, text);
}

QString lengthText(double mm) {
  return mm >= 10 ? QStringLiteral("%1 cm").arg(mm / 10) : QStringLiteral("%1 mm").arg(mm);
}

void paintScaleBar(QPainter& painter, double mmPerPixel, const QRectF& area) {
  const double mm = scaleBarMm(mmPerPixel, std::min(200.0, area.width() / 4));
  const double pixels = mm / mmPerPixel, y = area.bottom() - 1;
  const double left = std::round(area.center().x() - pixels / 2);
  for (const auto& [colour, width] : {std::pair(QColor(0, 0, 0, 200), 4.0), std::pair(textColour, 2.0)}) {
    painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(QPointF(left, y), QPointF(left + pixels, y));
    for (double x : {left, left + pixels}) painter.drawLine(QPointF(x, y - 4), QPointF(x, y + 1));
  }
  paintText(painter, QRectF(left, y - 24, pixels, 18), Qt::AlignCenter | Qt::TextDontClip, lengthText(mm),
            textColour);
}

}  // namespace

double scaleBarMm(double mmPerPixel, double mostPixels) {
  const double most = mmPerPixel * mostPixels, power = std::pow(10.0, std::floor(std::log10(most)));
  for (double factor : {5.0, 2.0})
    if (factor * power <= most) return factor * power;
  return power;
}

void paintOverlays(QPainter& painter, const Overlays& o, QRectF area) {
  const QRectF inside = area.adjusted(margin, margin, -margin, -margin);
  painter.setRenderHint(QPainter::Antialiasing);
  const double line = QFontMetricsF(painter.font()).height() + 1;
  const auto stack = [&](const QStringList& lines, int align) {
    for (int n = 0; n < lines.size(); ++n)
      paintText(painter, inside.adjusted(0, n * line, 0, 0), align | Qt::AlignTop, lines[n], textColour);
  };
  stack(o.topLeft, Qt::AlignLeft);
  stack(o.topRight, Qt::AlignRight);
  if (!o.warning.isEmpty())
    paintText(painter, inside.adjusted(0, double(o.topLeft.size()) * line, 0, 0),
              Qt::AlignLeft | Qt::AlignTop, o.warning, warningColour);
  paintText(painter, inside, Qt::AlignRight | Qt::AlignBottom, o.bottomRight, textColour);
  if (o.mmPerPixel > 0) paintScaleBar(painter, o.mmPerPixel, inside);
  // Letters with serifs: an I must not look like a stroke.
  painter.setFont(QFont(QStringLiteral("monospace"), painter.font().pointSize() + 2, QFont::Bold));
  paintText(painter, inside, Qt::AlignLeft | Qt::AlignVCenter, o.left, textColour);
  paintText(painter, inside, Qt::AlignRight | Qt::AlignVCenter, o.right, textColour);
  paintText(painter, inside, Qt::AlignHCenter | Qt::AlignTop, o.top, textColour);
  paintText(painter, inside.adjusted(0, 0, 0, -32), Qt::AlignHCenter | Qt::AlignBottom, o.bottom, textColour);
}

}  // namespace volumen
