#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace volumen {

/// Returns the UTF-8 text of `key` in the bytes of a PNG or a JPEG, as Qt writes it; empty if there is none.
/// Reads only text chunks, not pixels; a text is at most `mostBytes` long.
std::string textInPicture(std::span<const std::uint8_t> picture, const std::string& key,
                          std::size_t mostBytes);

/// True if the bytes begin like a PNG or a JPEG.
bool isPicture(std::span<const std::uint8_t> bytes);

}  // namespace volumen
