#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/decode.h"

namespace volumen::dicom {

/// Returns a colour picture as 8-bit RGB (PS3.3 C.7.6.3.1.2, C.7.9). Wider samples and palettes keep their
/// upper bits. A 16-bit palette that uses only 8 bits keeps those, with a sentence in `warnings`. Returns an
/// Error if the palette is missing or damaged.
Result<std::vector<std::uint8_t>> toRgb(const DecodedFrame& decoded, const PixelFormat& format,
                                        const DataSet& data, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
