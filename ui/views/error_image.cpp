#include "ui/views/error_image.h"

#include <algorithm>

#include "results/text/text.h"
#include "viewer/plan/options.h"
#include "viewer/volume/picture.h"

namespace volumen {

namespace {

QString legendOf(float white, float largest) {
  if (largest == 0) return tr("Estimated error: none");
  const QString text = tr("Estimated error: black 0, white %1/255").arg(double(white), 0, 'g', 2);
  return largest > white ? tr("%1 or more").arg(text) : text;
}

}  // namespace

ErrorImage errorImage(const std::vector<float>& map, QSize size) {
  if (map.empty() || map.size() != std::size_t(size.width()) * std::size_t(size.height()))
    return {{}, tr("Estimated error: not known for this picture")};
  const float largest = *std::ranges::max_element(map);
  const float white = std::min(largest, float(promiseOf(Quality::standard).most99));
  QImage image(size, QImage::Format_Grayscale8);
  for (int y = 0; y < size.height(); ++y) {
    const float* row = map.data() + std::size_t(size.width()) * y;
    std::transform(row, row + size.width(), image.scanLine(y),
                   [&](float error) { return white > 0 ? toByte(error / white) : std::uint8_t(0); });
  }
  return {image, legendOf(white, largest)};
}

}  // namespace volumen
