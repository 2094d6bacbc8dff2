#pragma once

#include <cstdint>
#include <string>

namespace volumen {

/// Returns the largest number of pixels in a readable frame: 2^28, or the value of setFramePixelLimit().
std::uint64_t framePixelLimit();

/// Returns "268 million pixels", for messages.
std::string framePixelLimitText();

/// Sets the limit for all later reads in this process and in workers started afterwards.
void setFramePixelLimit(std::uint64_t pixels);

}  // namespace volumen
