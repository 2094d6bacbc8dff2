#pragma once

#include <memory>

#include "io/files/byte_source.h"
#include "io/files/sample_type.h"

namespace volumen {

/// The samples that `file` spells out as decimal numbers from byte `offset` on, as bytes of `type` in this
/// machine's order. Reads must ask for whole samples. What is no number, or does not fit `type`, is an Error.
std::unique_ptr<ByteSource> decodeText(DataFile file, std::uint64_t offset, SampleType type);

}  // namespace volumen
