#pragma once

#include <cstdint>
#include <vector>

namespace volumen::bench {

/// Returns a picture of one unsigned sample of `bits` bits a pixel as a lossless JPEG 2000 codestream. Throws
/// if the library cannot encode it.
std::vector<std::uint8_t> encodeJpeg2000(const std::vector<std::uint16_t>& pixels, int columns, int rows,
                                         int bits);

}  // namespace volumen::bench
