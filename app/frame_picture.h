#pragma once

#include <QImage>
#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/slice/frame.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns the pixels of a frame with 8 bits a channel, row after row from the top. Colour frames have 3
/// bytes a pixel (RGB), grey frames have 1. Grey values are shown through `window`, or by default through
/// the first window or VOI LUT of the file.
std::vector<std::uint8_t> frameBytes(const Frame& frame, const std::optional<Window>& window);

/// Returns the bytes of frameBytes() as an image. `size` is columns x rows.
QImage pictureOfBytes(const std::vector<std::uint8_t>& bytes, glm::ivec2 size, bool colour);

/// Returns a picture with square pixels of one whose pixels are `mm` wide and high: as many along their
/// shorter side, more along the other one, interpolated. The Error: it would be too large.
Result<QImage> withSquarePixels(const QImage& image, glm::dvec2 mm);

}  // namespace volumen
