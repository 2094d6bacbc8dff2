#pragma once

#include <vector>

#include "io/dicom/bytes.h"
#include "viewer/volume/result.h"

namespace volumen::dicom {

/// What so many deflated bytes may become: 200 times as many, 16 MiB of few, 512 MiB at most.
std::size_t mostInflated(std::size_t deflatedBytes);

/// Inflates a raw deflate stream (PS3.5 A.5), also one in the wrapping of zlib or gzip. Refused: damaged
/// streams, and more than mostInflated.
Result<std::vector<std::uint8_t>> inflateAll(Bytes deflated);

}  // namespace volumen::dicom
