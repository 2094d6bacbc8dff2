#pragma once

#include <cstdint>
#include <string>

namespace volumen {

/// The most pixels that a frame may have to be read: 2^28, or what setFramePixelLimit() said.
std::uint64_t framePixelLimit();

/// "268 million pixels", for sentences.
std::string framePixelLimitText();

/// For all that is read from now on, in this process and in workers that are started behind it.
void setFramePixelLimit(std::uint64_t pixels);

}  // namespace volumen
