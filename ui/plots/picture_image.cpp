#include "ui/plots/picture_image.h"

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

}  // namespace volumen
