#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace volumen {

/// The text of this key in the bytes of a PNG or a JPEG, as Qt writes it, in UTF-8; empty: there is none.
/// Nothing but the places where texts stand is looked at, no pixels; a text is at most `mostBytes` long.
std::string textInPicture(std::span<const std::uint8_t> picture, const std::string& key,
                          std::size_t mostBytes);

/// Whether bytes begin as a PNG or a JPEG does.
bool isPicture(std::span<const std::uint8_t> bytes);

}  // namespace volumen
