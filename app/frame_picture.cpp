#include "app/frame_picture.h"

#include <cstring>

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

}  // namespace volumen
