#include "app/frame_picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/frame_limit.h"
#include "results/pictures/picture_greys.h"

namespace volumen {

std::vector<std::uint8_t> frameBytes(const Frame& frame, const std::optional<Window>& window) {
  if (frame.colour()) return frame.rgb;
  const GreyMapping& own = frame.greys.front().mapping;
  return frame.values.greyBytes(window ? throughWindow(own, *window) : own);
}

QImage pictureOfBytes(const std::vector<std::uint8_t>& bytes, glm::ivec2 size, bool colour) {
  const std::size_t width = std::size_t(size.x) * (colour ? 3 : 1);
  QImage image(size.x, size.y, colour ? QImage::Format_RGB888 : QImage::Format_Grayscale8);
  for (int y = 0; y < size.y; ++y)
    std::memcpy(image.scanLine(y), bytes.data() + width * std::size_t(y), width);
  return image;
}

Result<QImage> withSquarePixels(const QImage& image, glm::dvec2 mm) {
  const double side = std::min(mm.x, mm.y);
  const double width = std::round(image.width() * mm.x / side);
  const double height = std::round(image.height() * mm.y / side);
  if (width == image.width() && height == image.height()) return image;
  if (!(width * height <= double(framePixelLimit())))
    return Error{"Pixels are so much longer on one side that the picture would have more than " +
                 framePixelLimitText() + ": write frames as they are (volumen slice --plane frame)."};
  const QImage square =
      image.scaled(int(width), int(height), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  if (square.isNull()) return Error{"There is not enough memory for a picture with square pixels."};
  return square.convertToFormat(image.format());
}

}  // namespace volumen
