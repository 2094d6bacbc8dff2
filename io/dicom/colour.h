#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/decode.h"

namespace volumen::dicom {

/// The pixels of a colour picture as 8-bit RGB (PS3.3 C.7.6.3.1.2, C.7.9): wider samples and palettes by
/// their upper bits; a palette of 16 bits that uses 8 by those, which is said in `warnings`. An Error where
/// its palette is missing or damaged.
Result<std::vector<std::uint8_t>> toRgb(const DecodedFrame& decoded, const PixelFormat& format,
                                        const DataSet& data, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
