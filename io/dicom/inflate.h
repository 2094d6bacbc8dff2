#pragma once

#include <vector>

#include "io/dicom/bytes.h"
#include "viewer/volume/result.h"

namespace volumen::dicom {

/// Inflates a raw deflate stream (PS3.5 A.5). Refused: damaged streams, more than 512 MiB, and more than 200
/// times the input beyond 16 MiB.
Result<std::vector<std::uint8_t>> inflateRaw(Bytes deflated);

}  // namespace volumen::dicom
