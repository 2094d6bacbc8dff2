#pragma once

#include <QImage>
#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/slice/frame.h"

namespace volumen {

/// Returns the pixels of a frame with 8 bits a channel, row after row from the top. Colour frames have 3
/// bytes a pixel (RGB), grey frames have 1. Grey values are shown through `window`, or by default through
/// the first window or VOI LUT of the file.
std::vector<std::uint8_t> frameBytes(const Frame& frame, const std::optional<Window>& window);

/// Returns the bytes of frameBytes() as an image. `size` is columns x rows.
QImage pictureOfBytes(const std::vector<std::uint8_t>& bytes, glm::ivec2 size, bool colour);

}  // namespace volumen
