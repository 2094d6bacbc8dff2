#pragma once

#include <vector>

#include "io/dicom/bytes.h"
#include "viewer/volume/result.h"

namespace volumen::dicom {

/// Returns the largest allowed inflated size: 200 times the deflated one, but at least 64 MiB and at most 512
/// MiB.
std::size_t mostInflated(std::size_t deflatedBytes);

/// Inflates a raw deflate stream (PS3.5 A.5), also in zlib or gzip wrapping. Returns an Error for damaged
/// streams and for sizes above mostInflated.
Result<std::vector<std::uint8_t>> inflateAll(Bytes deflated);

}  // namespace volumen::dicom
