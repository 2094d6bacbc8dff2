#include "ui/controller/frame_picture.h"

#include <algorithm>
#include <cmath>

#include "viewer/slice/slice.h"

namespace volumen {

namespace {

using Bytes = std::vector<std::uint8_t>;

// Returns values 0 .. 255 as bytes; NaN becomes 0.
Bytes rounded(const std::vector<float>& values) {
  Bytes bytes(values.size());
  std::ranges::transform(values, bytes.begin(),
                         [](float v) { return std::isnan(v) ? 0 : std::uint8_t(v + 0.5f); });
  return bytes;
}

// Blends `colour` in where the mask is 1; the mask may be null.
Status addLayer(const LoadedFrame& frame, const VolumePtr& mask, const SlicePlane& plane, float colour,
                std::vector<Bytes*> channels) {
  if (!mask) return {};
  const Result<SliceValues> parts = resampleSlice(frame.seenOn(plane, mask), plane);
  if (!parts) return parts.error();
  for (Bytes* bytes : channels)
    for (std::size_t n = 0; n < bytes->size(); ++n)
      if (const float part = parts->values[n]; part > 0)
        (*bytes)[n] = std::uint8_t(std::lround((1 - part) * (*bytes)[n] + part * colour));
  return {};
}

QImage greyImage(glm::ivec2 size, const Bytes& grey) {
  QImage image(size.x, size.y, QImage::Format_Grayscale8);
  for (int y = 0; y < size.y; ++y)
    std::copy_n(grey.begin() + std::ptrdiff_t(y) * size.x, size.x, image.scanLine(y));
  return image;
}

QImage colourImage(glm::ivec2 size, const Bytes& red, const Bytes& green, const Bytes& blue) {
  QImage image(size.x, size.y, QImage::Format_RGB32);
  for (int y = 0; y < size.y; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    const std::size_t first = std::size_t(y) * std::size_t(size.x);
    for (int x = 0; x < size.x; ++x)
      line[x] =
          qRgb(red[first + std::size_t(x)], green[first + std::size_t(x)], blue[first + std::size_t(x)]);
  }
  return image;
}

}  // namespace

Result<QImage> drawFrame(const LoadedFrame& frame, const SlicePlane& plane, const GreyMapping& grey,
                         bool withLayers) {
  std::vector<Bytes> channels;
  for (const VolumePtr& volume : {frame.slice->volume, frame.green, frame.blue}) {
    if (!volume) continue;
    const Result<SliceValues> values = resampleSlice(frame.seenOn(plane, volume), plane);
    if (!values) return values.error();
    channels.push_back(frame.colour() ? rounded(values->values) : greyBytes(values->values, grey));
  }
  std::vector<Bytes*> all;
  for (Bytes& bytes : channels) all.push_back(&bytes);
  if (withLayers) {
    if (Status s = addLayer(frame, frame.shutter, plane, 255 * frame.shutterGrey, all); !s) return s.error();
    if (Status s = addLayer(frame, frame.overlays, plane, 255, all); !s) return s.error();
  }
  return frame.colour() ? colourImage(plane.size, channels[0], channels[1], channels[2])
                        : greyImage(plane.size, channels[0]);
}

}  // namespace volumen
