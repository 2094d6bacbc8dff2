#include "results/plots/picture_image.h"

#include <QColor>
#include <algorithm>
#include <cmath>

namespace volumen {

QImage imageOf(const Picture& picture) {
  const std::vector<std::uint8_t> bytes = toBytes(picture);
  const int channels = picture.transparent ? 4 : 3;
  QImage image(picture.size.x, picture.size.y, QImage::Format_RGB32);
  for (int y = 0; y < picture.size.y; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < picture.size.x; ++x) {
      const std::uint8_t* p = &bytes[std::size_t(channels) * (std::size_t(y) * picture.size.x + x)];
      line[x] = qRgb(p[0], p[1], p[2]);
    }
  }
  return image;
}

QImage differenceImage(const Picture& picture, const Truth& truth, double magnification) {
  QImage image(truth.grid.x, truth.grid.y, QImage::Format_RGB32);
  for (int y = 0; y < truth.grid.y; ++y)
    for (int x = 0; x < truth.grid.x; ++x) {
      const std::size_t n = std::size_t(y) * truth.grid.x + x;
      int c[3];
      for (int k = 0; k < 3; ++k) {
        const double by = std::abs(picture.rgba[4 * n + k] - truth.picture.rgba[4 * n + k]);
        c[k] = int(std::min(255.0, 255 * magnification * by));
      }
      image.setPixelColor(x, y, truth.well[n] ? QColor(c[0], c[1], c[2]) : QColor(0, 0, 110));
    }
  return image;
}

}  // namespace volumen
