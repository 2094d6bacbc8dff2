#pragma once

#include <QImage>
#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/slice/frame.h"

namespace volumen {

/// Returns a frame in 8 bits, 3 a pixel in colour and else 1: grey values through `window`, by default
/// through the first window or VOI LUT of the file.
std::vector<std::uint8_t> frameBytes(const Frame& frame, const std::optional<Window>& window);

/// Returns such bytes as a picture.
QImage pictureOfBytes(const std::vector<std::uint8_t>& bytes, glm::ivec2 size, bool colour);

}  // namespace volumen
