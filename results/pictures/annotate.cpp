#include "results/pictures/annotate.h"

#include <algorithm>

#include "results/pictures/picture_font.h"
#include "results/pictures/readable_text.h"

namespace volumen {

namespace {

constexpr double textPoints = 10;        // of the text, at scale 1
constexpr double edgeAtScale1 = 640;     // pixels
constexpr int dotsPerMeter = 3780;       // 96 an inch: converts points to pixels
constexpr double sideOfTopLetters = 60;  // pixels at scale 1, beside the centre

}  // namespace

void annotate(QImage& image, Overlays overlays) {
  const int before[] = {image.dotsPerMeterX(), image.dotsPerMeterY()};
  image.setDotsPerMeterX(dotsPerMeter);
  image.setDotsPerMeterY(dotsPerMeter);
  {
    QPainter painter(&image);
    QFont font = pictureFont();
    font.setPointSizeF(textPoints);
    painter.setFont(font);
    const QFontMetricsF metrics(font, &image);
    const double width = image.width(), height = image.height();
    double widest = 1;
    for (const QString& line : overlays.warning.split(QLatin1Char('\n')))
      widest = std::max(widest, metrics.horizontalAdvance(line) + 24);
    const double scale = std::min(std::max(0.9, std::min(width, height) / edgeAtScale1), width / widest);
    // Long names must not run into the letter at the top.
    const double room = width / scale / 2 - sideOfTopLetters;
    for (QString& line : overlays.topLeft)
      if (leadingDate(line).isEmpty()) line = metrics.elidedText(line, Qt::ElideMiddle, room);
    overlays.mmPerPixel *= scale;
    painter.scale(scale, scale);
    paintOverlays(painter, overlays, {0, 0, width / scale, height / scale});
  }
  image.setDotsPerMeterX(before[0]);
  image.setDotsPerMeterY(before[1]);
}

Overlays warningOverlays(const std::vector<Warning>& warnings) {
  QStringList lines;
  for (const std::string& text : shortWarnings(warnings)) lines << QString::fromStdString(text);
  Overlays overlays;
  overlays.warning = lines.join(QLatin1Char('\n'));
  return overlays;
}

}  // namespace volumen
